// SPDX-License-Identifier: Apache-2.0
// The waves of the sea's surface: 32 sines that repeat on a tile, shared by the caustics and by the
// surface as seen from below.
#pragma once

#include <array>
#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

namespace aquarama {

inline constexpr int kWaves = 32;
inline constexpr float kTileMetres = 12.0F;  // as in water.glsl

struct Wave {
    glm::dvec2 number{};  // 1/m, a whole number of waves on the tile
    double amplitudeMetres = 0;
    double phase = 0;
    double frequency = 0;  // rad/s, deep water: sqrt(9.81 k)
};
using Waves = std::array<Wave, kWaves>;

// As steep as makes the net of light sharpest on sand at this depth: see focusNumber.
[[nodiscard]] Waves wavesOf(std::uint32_t seed, float focusDepthMetres);

// The block of sea_now.glsl at a time: phases are reduced in double precision, so that months of
// running change nothing.
struct SeaNow {
    std::array<glm::vec4, kWaves> waves{};  // k.x, k.z, amplitude, phase
    glm::vec4 swellPhases{};                // of the long and the short swell, and of two flutters
};
[[nodiscard]] SeaNow seaAt(const Waves& waves, double timeSeconds);

// 0.25 depth times the rms curvature of the surface.
[[nodiscard]] double focusNumber(const Waves& waves, double depthMetres);

}  // namespace aquarama
