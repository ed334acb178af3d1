// SPDX-License-Identifier: Apache-2.0
// Jerlov's types of sea water: what each does to light, at 31 bands of the spectrum.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

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

// Towards the sun as seen in the water: before the wall and to its left, 55 degrees up.
[[nodiscard]] glm::vec3 sunInWater();

// Of the scattered light, so much goes so nearly straight on that it stays in the picture.
inline constexpr double kStaysInPicture = 0.49;
// What dims the way to the eye: a + 0.51 b.
[[nodiscard]] double beamAttenuation(const WaterSpectra& water, std::size_t band);

// What sea water does to light, integrated over 31 bands of the spectrum into tables for the
// shaders: separate coefficients for the way down (Kd) and for the way to the eye (a + 0.51 b).

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

// Light scattered into the view from 60 m of water, without the lobes of direction: over
// sqrt((depth + 10 m) / 40 m) and rise, (w_y + 1) / 2. For mirrors.
[[nodiscard]] Table bakeOpenWater(const WaterSpectra& water);

// The diver's filter: of the water above an eye at this depth it undoes so many metres, as the
// white balance of a camera would: a spectral gain exp(Kd z_f), so that depths are looked up z_f
// higher. Never all of it: distance and depth stay blue. Smooth, for an eye that dives.
[[nodiscard]] double filterDepthMetres(double eyeDepthMetres);

// Light scattered into the view on the way from the eye, without the lobes of the shaders: layers
// over the cosine of the azimuth from the sun's, -1 to 1; in each sqrt(range / 80 m) and rise.
// Baked for eyes at several depths, between which it is mixed, so that the submarine may dive.
class Inscatter {
  public:
    explicit Inscatter(const WaterSpectra& water);
    // From what texels() and exposures() returned.
    Inscatter(std::span<const glm::vec3> texels, std::vector<double> exposures);
    [[nodiscard]] Table atDepth(double eyeDepthMetres) const;
    // Into a table of `atDepth`; takes no memory.
    void mixAtDepth(double eyeDepthMetres, Table& table) const;
    // What makes the water about an eye at this depth bright enough to be seen and dark enough to
    // hold its colour, before daylight. Smooth in depth.
    [[nodiscard]] double exposureAt(double eyeDepthMetres) const;

    [[nodiscard]] std::vector<glm::vec3> texels() const;  // of all depths of the eye, one by one
    [[nodiscard]] const std::vector<double>& exposures() const { return exposures_; }

  private:
    [[nodiscard]] Table baked(const WaterSpectra& water, double eyeDepthMetres) const;

    std::vector<Table> slices_;
    std::vector<double> exposures_;
};

// All of a type of water. Baked once on a machine: derived data.
struct WaterTables {
    Inscatter inscatter;
    Table direct, openWater;
};
[[nodiscard]] WaterTables waterTables(config::WaterType type);

// Kd of daylight's three primaries about the depth that the filter leaves, 1/m.
[[nodiscard]] glm::vec3 primariesDownwelling(const WaterSpectra& water);

}  // namespace aquarama::scene
