// SPDX-License-Identifier: Apache-2.0
// What sea water does to light, integrated over 31 bands of the spectrum into tables for the
// shaders: separate coefficients for the way down (Kd) and for the way to the eye (a + 0.51 b).
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace aquarama {

inline constexpr std::size_t kBands = 31;  // 400 to 700 nm by 10
using Spectrum = std::array<double, kBands>;

// Clear ocean water, Jerlov's type IA, 1/m.
struct WaterSpectra {
    Spectrum absorption{};     // a
    Spectrum scattering{};     // b
    Spectrum downwelling{};    // Kd
    Spectrum weights[3];       // band to linear Rec. 709; daylight D65 gives (1, 1, 1)
    Spectrum reflectances[3];  // smooth red, green, blue surfaces that sum to white
};
[[nodiscard]] WaterSpectra oceanWater();

// Unscattered share of the way to the eye: of the scattered light, 0.49 goes so nearly straight on
// that it stays in the picture.
[[nodiscard]] double beamAttenuation(const WaterSpectra& water, std::size_t band);

inline constexpr double kFarthestMetres = 80.0;
inline constexpr double kDeepestMetres = 30.0;
// Depths begin above the surface: the diver's filter may undo more water than there is.
inline constexpr double kDepthOffsetMetres = 10.0;

struct Table {
    int width = 0, height = 0, layers = 1;
    std::vector<glm::vec3> texels;  // x fastest, then y, then layer
};

// 3x3 matrices over sqrt(range / 80 m) and sqrt((depth + 10 m) / 40 m); layers are the columns.
[[nodiscard]] Table bakeDirect(const WaterSpectra& water);

// Light scattered into the view, without the lobes of direction: over sqrt(range / 80 m) and rise
// (w_y + 1) / 2 for an eye at one depth, or over depth and rise for 60 m of water.
class Inscatter {
  public:
    explicit Inscatter(const WaterSpectra& water);
    [[nodiscard]] Table atDepth(double depthMetres) const;
    [[nodiscard]] Table openWater() const;

  private:
    [[nodiscard]] Spectrum lightAt(double depthMetres) const;
    [[nodiscard]] glm::vec3 along(const Spectrum& light, int range, int rise) const;

    WaterSpectra water_;
    std::vector<Spectrum> paths_;  // b (1 - exp(-k r)) / k for every range and rise
};

}  // namespace aquarama
