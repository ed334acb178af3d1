// SPDX-License-Identifier: Apache-2.0
// Jerlov's types of sea water: what each does to light, at 31 bands of the spectrum.
#pragma once

#include <array>
#include <cstddef>

#include "common/config/scene.h"

namespace aquarama::scene {

inline constexpr std::size_t kBands = 31;  // 400 to 700 nm by 10
using Spectrum = std::array<double, kBands>;
[[nodiscard]] double wavelengthOf(std::size_t band);  // nanometres

// Coefficients in 1/m.
struct WaterSpectra {
    Spectrum absorption{};     // a
    Spectrum scattering{};     // b
    Spectrum downwelling{};    // Kd
    Spectrum weights[3];       // band to linear Rec. 709; daylight D65 gives (1, 1, 1)
    Spectrum reflectances[3];  // smooth red, green, blue surfaces that sum to white
};
[[nodiscard]] WaterSpectra seaWater(config::WaterType type);

// Of the scattered light, so much goes so nearly straight on that it stays in the picture.
inline constexpr double kStaysInPicture = 0.49;
// What dims the way to the eye: a + 0.51 b.
[[nodiscard]] double beamAttenuation(const WaterSpectra& water, std::size_t band);

}  // namespace aquarama::scene
