// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/waves.h"

#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/place/noise.h"

namespace aquarama {

namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kGravity = 9.81;
// Headings by the golden angle: a short sea from all sides, whose net of light has no grain.
constexpr double kGoldenAngle = 2.39996;
constexpr double kLongestMetres = 4.2;
constexpr double kShortestShare = 0.2;  // of the longest

constexpr double kSteepening = 0.35;  // slopes grow with wavelength to this power
// Below 0.3 the net of light is faint, above 0.8 it breaks into cords and sheets.
constexpr double kSharpestNet = 0.44;

}  // namespace

Waves wavesOf(std::uint32_t seed, float focusDepthMetres) {
    Waves waves;
    for (std::uint32_t i = 0; i < kWaves; ++i) {
        const auto unit = [&](std::uint32_t n) {
            return static_cast<double>(unitOf(hashOf(hashOf(seed ^ 0x7a5eU, i), n)));
        };
        const double length = kLongestMetres * std::pow(kShortestShare, (i + 0.5) / kWaves);
        const double heading = kGoldenAngle * i + 0.6 * (unit(0) - 0.5);
        const auto tile = static_cast<double>(kTileMetres);
        glm::dvec2 onTile =
            glm::round(glm::dvec2{std::cos(heading), std::sin(heading)} * (tile / length));
        if (onTile == glm::dvec2{0.0}) onTile = {1.0, 0.0};
        Wave& wave = waves[i];
        wave.number = onTile * (kTwoPi / tile);
        const double number = glm::length(wave.number);
        wave.amplitudeMetres = std::pow(kTwoPi / number / 2.0, kSteepening) / number;
        wave.phase = kTwoPi * unit(1);
        wave.frequency = std::sqrt(kGravity * number);
    }
    const double scale = kSharpestNet / focusNumber(waves, static_cast<double>(focusDepthMetres));
    for (Wave& wave : waves) wave.amplitudeMetres *= scale;
    return waves;
}

SeaNow seaAt(const Waves& waves, double timeSeconds) {
    SeaNow now;
    for (std::size_t i = 0; i < waves.size(); ++i) {
        const Wave& wave = waves[i];
        const double phase = std::fmod(wave.phase - wave.frequency * timeSeconds, kTwoPi);
        now.waves[i] = glm::vec4(glm::dvec4(wave.number, wave.amplitudeMetres, phase));
    }
    // Swells of 7 and 4.3 s.
    constexpr glm::dvec4 kFrequencies{0.898, 1.461, 2.3, 2.7};
    for (int i = 0; i < 4; ++i)
        now.swellPhases[i] = static_cast<float>(std::fmod(kFrequencies[i] * timeSeconds, kTwoPi));
    return now;
}

double focusNumber(const Waves& waves, double depthMetres) {
    double variance = 0;
    for (const Wave& wave : waves) {
        const double curvature = glm::dot(wave.number, wave.number) * wave.amplitudeMetres;
        variance += 0.5 * curvature * curvature;
    }
    return 0.25 * depthMetres * std::sqrt(variance);
}

}  // namespace aquarama
