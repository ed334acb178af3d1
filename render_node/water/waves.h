// SPDX-License-Identifier: Apache-2.0
// The waves of the sea's surface: two sets of 32 sines, each periodic on its own tile, and a few
// long ones that are not periodic. The waves focus the sunlight; the ripples only roughen the
// surface as seen from below.
#pragma once

#include <array>
#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace aquarama::scene {

inline constexpr int kWaves = 32;
inline constexpr int kLongWaves = 4;

// One sine: amplitude * sin(number . x + phase - frequency * t), x in metres on the surface.
struct Wave {
    // Wave number along world x and z, rad/m.
    glm::dvec2 number{};
    double amplitudeMetres = 0;
    double phase = 0;
    // rad/s: a fixed share of that of deep water, sqrt(g k + 7.4e-5 k^3).
    double frequency = 0;
};
template <std::size_t Count>
using WaveSet = std::array<Wave, Count>;
using Waves = WaveSet<kWaves>;

// All waves of a sea.
struct Sea {
    // Wavelengths of 3.8 to 0.55 m, a whole number of them on the tile.
    Waves waves;
    // Wavelengths of 0.5 to 0.05 m, a whole number of them on their tile.
    Waves ripples;
    // Wavelengths of 6 to 15 m.
    WaveSet<kLongWaves> longWaves;
};
// Waves whose steepness makes caustics sharpest on sand at this depth: see focusNumber(). calmSea()
// has no waves.
[[nodiscard]] Sea seaOf(std::uint32_t seed, float focusDepthMetres);
[[nodiscard]] Sea calmSea();

// The uniform block of sea_now.glsl at a moment, std140. Phases are reduced in double precision, so
// that they stay exact for months.
struct SeaNow {
    std::array<glm::vec4, kWaves> waves{};          // k.x, k.z, amplitude, phase
    std::array<glm::vec4, kWaves> ripples{};        // the same
    std::array<glm::vec4, kLongWaves> longWaves{};  // the same
    glm::vec4 swellPhases{};  // of the long and the short swell, and of two flutters
    // Of the layers of caustics: depth of the first, 1 / log2 of the ratio of two, number of the
    // last; texels against 256, log2.
    glm::vec4 causticAxis{};
    // Taps of the surface a pixel; share of water's dispersion; texels a metre of the waves' and of
    // the ripples' tile.
    glm::vec4 surfaceDetail{};
    // Of the map of fish: its middle where the sun's rays meet the surface, 1 / its side.
    glm::vec4 fishWindow{};
};
// Fills in waves and swell; SeaLight fills in the other members.
[[nodiscard]] SeaNow seaAt(const Sea& sea, double timeSeconds);

// 0.25 * depth * rms curvature of the surface, without unit: how well the waves focus light at this
// depth.
[[nodiscard]] double focusNumber(const Waves& waves, double depthMetres);
// The rms slope of the surface.
[[nodiscard]] double steepness(const Waves& waves);

}  // namespace aquarama::scene
