// SPDX-License-Identifier: Apache-2.0
// The waves of the sea's surface: two sets of 32 sines, each of which repeats on its own tile, and
// a few long ones that never do. The waves gather the sunlight; the ripples only break up what is
// seen in the surface from below.
#pragma once

#include <array>
#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace aquarama::scene {

inline constexpr int kWaves = 32;
inline constexpr int kLongWaves = 4;

struct Wave {
    glm::dvec2 number{};  // 1/m
    double amplitudeMetres = 0;
    double phase = 0;
    double frequency = 0;  // rad/s: a share of that of deep water, sqrt(g k + 7.4e-5 k^3)
};
template <std::size_t Count>
using WaveSet = std::array<Wave, Count>;
using Waves = WaveSet<kWaves>;

struct Sea {
    Waves waves;                    // 3.8 to 0.55 m, a whole number of them on the tile
    Waves ripples;                  // 0.5 to 0.05 m, a whole number of them on theirs
    WaveSet<kLongWaves> longWaves;  // 6 to 15 m
};
// Waves as steep as makes caustics sharpest on sand at this depth: see focusNumber. Calm:
// a mirror, without any wave.
[[nodiscard]] Sea seaOf(std::uint32_t seed, float focusDepthMetres);
[[nodiscard]] Sea calmSea();

// The block of sea_now.glsl at a time: phases are reduced in double precision, so that months of
// running change nothing.
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
[[nodiscard]] SeaNow seaAt(const Sea& sea, double timeSeconds);

// 0.25 depth times the rms curvature of the surface.
[[nodiscard]] double focusNumber(const Waves& waves, double depthMetres);
// Root of the mean square of the slope.
[[nodiscard]] double steepness(const Waves& waves);

}  // namespace aquarama::scene
