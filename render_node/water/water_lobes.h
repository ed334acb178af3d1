// SPDX-License-Identifier: Apache-2.0
// From where the light comes that water scatters into a view: a table over the water's albedo b/c,
// the eye's optical depth and the direction, traced by the Monte Carlo of
// tests/support/water_light.h and written by aquarama_trace_water. One table serves all types of
// water, as their particles scatter alike.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

namespace aquarama::scene {

inline constexpr std::array kLobeAlbedos{0.03, 0.20, 0.40, 0.60, 0.75, 0.87};
inline constexpr std::array kLobeDepths{0.15, 0.6, 1.5, 3.5, 8.0, 20.0};  // optical: c z
// Of the direction: its rise w_y, and how far round from the sun's azimuth, degrees.
inline constexpr std::array kLobeRises{-1.0, -0.75, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75, 1.0};
inline constexpr std::array kLobeAzimuths{0.0, 45.0, 90.0, 135.0, 180.0};
inline constexpr std::size_t kLobeEntries =
    kLobeAlbedos.size() * kLobeDepths.size() * kLobeRises.size() * kLobeAzimuths.size();

struct WaterLobe {
    // Light scattered into the view at the eye, for each unit of irradiance there, of b and of what
    // `plainLobe` says of the direction.
    double source = 1;
    double loss = 1;  // how it falls along the way, in units of c
};
// In thousandths: of the logarithm of the source, of the loss. Albedos slowest, azimuths fastest.
struct LobeEntry {
    std::int16_t lnSource, loss;
};
extern const std::array<LobeEntry, kLobeEntries> kLobeTable;

// Smooth between the entries.
[[nodiscard]] WaterLobe waterLobe(double albedo,
                                  double opticalDepth,
                                  double rise,
                                  double azimuthDegrees);

// The lobes of the shaders: about the refracted sun, and about all light that comes down.
[[nodiscard]] double plainLobe(glm::dvec3 direction, glm::dvec3 towardsSun);

}  // namespace aquarama::scene
