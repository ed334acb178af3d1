// SPDX-License-Identifier: Apache-2.0
#include "render_node/water/waves.h"

#include <cassert>
#include <cmath>
#include <numbers>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/base/hash.h"
#include "render_node/shaders/shader_interface.h"

namespace aquarama::scene {

namespace {

constexpr double kTwoPi = 2.0 * std::numbers::pi;
constexpr double kGravity = 9.81;
constexpr double kTension = 7.4e-5;  // of water against air by density, m3/s2
// Consecutive headings differ by the golden angle, radians: waves from all sides, so that caustics
// have no grain.
constexpr double kGoldenAngle = 2.39996;
// The focus number of the waves. Below 0.3 caustics are faint; above 0.8 they break into cords and
// sheets.
constexpr double kSharpestNet = 0.56;
// The rms slope of the ripples. Together with the waves it is about 0.17, the slope of Cox and Munk
// 1954 for a breeze of 5 m/s.
constexpr double kRippleSteepness = 0.125;
constexpr double kLongSteepness = 0.055;

// A band of wavelengths from longest to longest * shortestShare; how slopes grow with the
// wavelength (exponent `steepening`); and `pace`, the share of the natural frequency at which the
// waves run.
struct Band {
    double longestMetres, shortestShare, steepening, pace;
};
// The waves run at 0.55 of their natural frequency: at full speed caustics change within a tenth of
// a second, which looks like flicker.
constexpr Band kWaveBand{3.8, 0.14, 0.45, 0.55};
constexpr Band kRippleBand{0.5, 0.10, 0.25, 1.0};
constexpr Band kLongBand{15.0, 0.4, 0.0, 1.0};

// Dispersion of gravity-capillary waves in deep water, rad/s.
double frequencyOf(double number) {
    return std::sqrt(kGravity * number + kTension * number * number * number);
}

// Wavelengths evenly spaced in their logarithm, headings and phases from the seed. Wave numbers are
// rounded to whole waves on the tile; tileMetres 0 leaves them as they are. Amplitudes are
// relative: scale() sets them.
template <std::size_t Count>
WaveSet<Count> wavesOf(std::uint32_t seed, const Band& band, double tileMetres) {
    WaveSet<Count> waves;
    for (std::uint32_t i = 0; i < Count; ++i) {
        const auto unit = [&](std::uint32_t n) {
            return static_cast<double>(unitOf(hashOf(hashOf(seed ^ 0x7a5eU, i), n)));
        };
        const double length = band.longestMetres * std::pow(band.shortestShare, (i + 0.5) / Count);
        const double heading = kGoldenAngle * i + 0.6 * (unit(0) - 0.5);
        Wave& wave = waves[i];
        wave.number = glm::dvec2{std::cos(heading), std::sin(heading)} * (kTwoPi / length);
        if (tileMetres > 0) {
            glm::dvec2 onTile = glm::round(wave.number * (tileMetres / kTwoPi));
            if (onTile == glm::dvec2{0.0}) onTile = {1.0, 0.0};
            wave.number = onTile * (kTwoPi / tileMetres);
        }
        const double number = glm::length(wave.number);
        wave.amplitudeMetres = std::pow(kTwoPi / number / 2.0, band.steepening) / number;
        wave.phase = kTwoPi * unit(1);
        wave.frequency = band.pace * frequencyOf(number);
    }
    return waves;
}

template <std::size_t Count>
void scale(WaveSet<Count>& waves, double by) {
    for (Wave& wave : waves) wave.amplitudeMetres *= by;
}

template <std::size_t Count>
// Sum of (k a)^2 / 2.
double meanSquareSlope(const WaveSet<Count>& waves) {
    double sum = 0;
    for (const Wave& wave : waves)
        sum +=
            0.5 * glm::dot(wave.number, wave.number) * wave.amplitudeMetres * wave.amplitudeMetres;
    return sum;
}

template <std::size_t Count>
// Phases at a time, reduced to one period.
void setPhases(const WaveSet<Count>& waves, double timeSeconds, std::array<glm::vec4, Count>& now) {
    for (std::size_t i = 0; i < Count; ++i) {
        const Wave& wave = waves[i];
        const double phase = std::fmod(wave.phase - wave.frequency * timeSeconds, kTwoPi);
        now[i] = glm::vec4(glm::dvec4(wave.number, wave.amplitudeMetres, phase));
    }
}

}  // namespace

Sea seaOf(std::uint32_t seed, float focusDepthMetres) {
    assert(focusDepthMetres > 0.0F);
    Sea sea{
        wavesOf<kWaves>(seed, kWaveBand, static_cast<double>(shaders::kTileMetres)),
        wavesOf<kWaves>(hashOf(seed), kRippleBand, static_cast<double>(shaders::kRippleTileMetres)),
        wavesOf<kLongWaves>(hashOf(seed, 2), kLongBand, 0.0)};
    scale(sea.waves, kSharpestNet / focusNumber(sea.waves, static_cast<double>(focusDepthMetres)));
    scale(sea.ripples, kRippleSteepness / steepness(sea.ripples));
    scale(sea.longWaves, kLongSteepness / std::sqrt(meanSquareSlope(sea.longWaves)));
    return sea;
}

Sea calmSea() {
    return {};
}

SeaNow seaAt(const Sea& sea, double timeSeconds) {
    assert(std::isfinite(timeSeconds));
    SeaNow now;
    setPhases(sea.waves, timeSeconds, now.waves);
    setPhases(sea.ripples, timeSeconds, now.ripples);
    setPhases(sea.longWaves, timeSeconds, now.longWaves);
    // rad/s: swells of 7 and 4.3 s, and two flutters of plants.
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

double steepness(const Waves& waves) {
    return std::sqrt(meanSquareSlope(waves));
}

}  // namespace aquarama::scene
