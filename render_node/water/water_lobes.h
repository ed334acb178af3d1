// SPDX-License-Identifier: Apache-2.0
// The angular distribution of the light that water scatters into a view: a table over the water's
// albedo b/c, the eye's optical depth and the direction. It was traced by the Monte Carlo of
// tests/support/water_light.h and written by aquarama_trace_water. One table serves all types of
// water, as their particles scatter alike.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

namespace aquarama::scene {

// The nodes of the table. Single scattering albedo b/c.
inline constexpr std::array kLobeAlbedos{0.03, 0.20, 0.40, 0.60, 0.75, 0.87};
// Optical depth of the eye, c z.
inline constexpr std::array kLobeDepths{0.15, 0.6, 1.5, 3.5, 8.0, 20.0};
// Direction of view: its rise w_y, and its azimuth from the sun's, degrees.
inline constexpr std::array kLobeRises{-1.0, -0.75, -0.5, -0.25, 0.0, 0.25, 0.5, 0.75, 1.0};
inline constexpr std::array kLobeAzimuths{0.0, 45.0, 90.0, 135.0, 180.0};
inline constexpr std::size_t kLobeEntries =
    kLobeAlbedos.size() * kLobeDepths.size() * kLobeRises.size() * kLobeAzimuths.size();

// The light along one direction of view.
struct WaterLobe {
    // Light scattered into the view at the eye, relative to b, to the irradiance there and to
    // plainLobe() of the direction.
    double source = 1;
    // How fast that light falls along the way, relative to c.
    double loss = 1;
};
// An entry, in thousandths: the logarithm of the source, and the loss. In the table albedos vary
// slowest and azimuths fastest.
struct LobeEntry {
    std::int16_t lnSource, loss;
};
extern const std::array<LobeEntry, kLobeEntries> kLobeTable;

// Interpolates the table smoothly in all four variables; outside the nodes the nearest entry holds.
// rise: -1 to 1. azimuthDegrees: 0 to 180. Costs 256 entries: for tables that are made once.
[[nodiscard]] WaterLobe waterLobe(double albedo,
                                  double opticalDepth,
                                  double rise,
                                  double azimuthDegrees);

// The two lobes that the shaders evaluate (water.glsl): about the refracted sun, and about all
// light that comes down. Unit vectors; 1/sr.
[[nodiscard]] double plainLobe(glm::dvec3 direction, glm::dvec3 towardsSun);

}  // namespace aquarama::scene
