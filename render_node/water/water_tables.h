// SPDX-License-Identifier: Apache-2.0
// Jerlov's types of sea water, and tables of their effect on light. Light is integrated over 31
// bands of the spectrum, then stored as linear Rec. 709.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "common/config/scene.h"

namespace aquarama::scene {

// Bands of 10 nm, their middles at 400 to 700 nm.
inline constexpr std::size_t kBands = 31;
using Spectrum = std::array<double, kBands>;
// Middle of a band, nanometres.
[[nodiscard]] double wavelengthOf(std::size_t band);

// Optical properties of one type of water, by band. Coefficients in 1/m.
struct WaterSpectra {
    Spectrum absorption{};   // a
    Spectrum scattering{};   // b
    Spectrum downwelling{};  // Kd
    // From a band to linear Rec. 709 red, green, blue; daylight D65 gives (1, 1, 1).
    Spectrum weights[3];
    // Smooth reflectances of a red, a green and a blue surface, which sum to white.
    Spectrum reflectances[3];
};
// The properties of a type of water; sources are in water_tables.cpp.
[[nodiscard]] WaterSpectra seaWater(config::WaterType type);

// Unit vector towards the sun as seen in the water, world frame: ahead of the wall and to its left,
// 55 degrees above the horizon.
[[nodiscard]] glm::vec3 sunInWater();

// The share of the scattered light that continues so nearly straight on that it stays in the
// picture.
inline constexpr double kStaysInPicture = 0.49;
// Attenuation of a picture on the way to the eye, 1/m: a + 0.51 b.
[[nodiscard]] double beamAttenuation(const WaterSpectra& water, std::size_t band);

// Tables for the shaders. The way down and the way to the eye have separate coefficients: Kd and a
// + 0.51 b.

// Ends of the axes of range and depth.
inline constexpr double kFarthestMetres = 80.0;
inline constexpr double kDeepestMetres = 30.0;
// The axis of depth begins this far above the surface, as the diver's filter may undo more water
// than there is.
inline constexpr double kDepthOffsetMetres = 10.0;

// A table of linear Rec. 709 light, to become a texture.
struct Table {
    int width = 0, height = 0, layers = 1;
    std::vector<glm::vec3> texels;  // x fastest, then y, then layer
};

// A share of the colour that water takes on the way is given back, as cameras of divers do: 0 none,
// the picture as in nature, to 1 all. Luminance stays, and so does the light that water adds, so
// that far things are as dim and as veiled as they were. The way down is balanced sooner, wholly
// from 0.8 on, as a white balance for this depth would; of the way to the eye that share.
struct Grade {
    double toEye = 0, down = 0;
};
[[nodiscard]] Grade gradeOf(double colourReturned);

// Attenuation of a thing's light on the way down and to the eye: 3x3 matrices for linear Rec. 709,
// whose columns are three layers; and, in a fourth, what white light would be without the grade, as
// a share of each primary. x: sqrt(range / 80 m); y: sqrt((depth + 10 m) / 40 m).
[[nodiscard]] Table bakeDirect(const WaterSpectra& water, Grade grade = {});

// Light scattered into the view by 60 m of water, without the lobes of direction; for mirrors. x:
// sqrt((depth + 10 m) / 40 m); y: (rise w_y + 1) / 2.
[[nodiscard]] Table bakeOpenWater(const WaterSpectra& water);

// The diver's filter, as the white balance of a camera: for an eye at this depth it undoes the
// attenuation by so many metres of water, a spectral gain of exp(Kd z_f). Depths are therefore
// looked up z_f higher. It never undoes all of the depth, so that distance and depth remain blue.
// Smooth in depth.
[[nodiscard]] double filterDepthMetres(double eyeDepthMetres);

// Light scattered into the view between the eye and a range, without the lobes of the shaders.
// Layers: (cosine of the azimuth from the sun's, -1 to 1); x: sqrt(range / 80 m); y: rise. It is
// made for eyes at several depths and mixed between them, so that the submarine may dive.
class Inscatter {
  public:
    // Computes the tables of all depths.
    explicit Inscatter(const WaterSpectra& water);
    // Restores an object from what texels() and exposures() returned.
    Inscatter(std::span<const glm::vec3> texels, std::vector<double> exposures);
    // The table for an eye at this depth, metres.
    [[nodiscard]] Table atDepth(double eyeDepthMetres) const;
    // Writes the same into a table that atDepth() has made; allocates nothing.
    void mixAtDepth(double eyeDepthMetres, Table& table) const;
    // The factor of exposure for an eye at this depth, before daylight: the water about it is
    // bright enough to be seen and dark enough to keep its colour. Smooth in depth.
    [[nodiscard]] double exposureAt(double eyeDepthMetres) const;

    // The texels of all depths of the eye, one table after the other.
    [[nodiscard]] std::vector<glm::vec3> texels() const;
    [[nodiscard]] const std::vector<double>& exposures() const { return exposures_; }

  private:
    [[nodiscard]] Table baked(const WaterSpectra& water, double eyeDepthMetres) const;

    // One table and one exposure for each depth of the eye.
    std::vector<Table> slices_;
    std::vector<double> exposures_;
};

// bakeDirect() for evenly spaced shares of colour returned, and mixed between them, so that it can
// be set while a show runs.
class GradedDirect {
  public:
    // Computes the tables of all shares.
    explicit GradedDirect(const WaterSpectra& water);
    // Restores an object from what texels() returned.
    explicit GradedDirect(std::span<const glm::vec3> texels);
    // The table for this share, 0 to 1: as baked at multiples of 0.2.
    [[nodiscard]] Table at(double colourReturned) const;
    // Writes the same into a table that at() has made; allocates nothing.
    void mixAt(double colourReturned, Table& table) const;
    // The texels of all shares, one table after the other.
    [[nodiscard]] std::vector<glm::vec3> texels() const;

  private:
    std::vector<Table> slices_;
};

// All tables of a type of water.
struct WaterTables {
    Inscatter inscatter;
    GradedDirect direct;
    Table openWater;
};
// Takes them from the cache of derived data, or computes them once on this machine.
[[nodiscard]] WaterTables waterTables(config::WaterType type);

// Kd of daylight's three primaries near the depth that the filter leaves, 1/m.
[[nodiscard]] glm::vec3 primariesDownwelling(const WaterSpectra& water, Grade grade = {});

}  // namespace aquarama::scene
