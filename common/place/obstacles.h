// SPDX-License-Identifier: Apache-2.0
// The obstacles of fish: sand, rocks and kelp in their water, and a chart of them, precomputed on a
// grid, so that a fish looks them up instead of computing them. World frame, metres.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/place/place.h"

namespace aquarama::place {

// How far beyond its radius a rock is felt, and beyond its root a stem, metres: so far it is
// listed.
inline constexpr float kRockReachMetres = 0.3F + 0.6F;
inline constexpr float kStemRadiusMetres = 0.15F;  // of a kelp plant with its fronds
inline constexpr float kStemReachMetres = kStemRadiusMetres + 0.35F;

// A kelp plant as an obstacle: a vertical stem from the sand to its top.
struct Stem {
    // x and z of its root.
    glm::vec2 foot{};
    // Height y of its top.
    float topMetres = 0;
};

// An obstacle is listed in every cell that is this near to its footprint, metres.
inline constexpr float kChartReachMetres = 2.7F;
// Spacing of the grid of sand heights, metres. Heights interpolated between its corners are exact
// to 5 mm.
inline constexpr float kChartStepMetres = 0.25F;

// Made once per scene and constant afterwards: any thread may read it. A lookup is O(1).
class Chart {
  public:
    // The circle that an obstacle covers in plan (x, z), and the height y of its top.
    struct Footprint {
        glm::vec2 xz{};
        float radiusMetres = 0;
        float topMetres = 0;
    };
    Chart() = default;
    // Covers the water and 1.5 m around it. Footprints are numbered in the order given.
    Chart(const PlaceKey& place, const Region& water, std::span<const Footprint> footprints);

    // Whether a place (x, z) is on the chart; sand() and near() may be called only for such.
    [[nodiscard]] bool covers(glm::vec2 xz) const {
        const glm::vec2 at = xz - origin_;
        return at.x >= 0 && at.y >= 0 && at.x < extent_.x && at.y < extent_.y;
    }
    // Height of the sand by bilinear interpolation. In an open sea it is constant.
    [[nodiscard]] float sand(glm::vec2 xz) const;
    // The greatest height at any corner of the grid.
    [[nodiscard]] float highestSand() const { return highest_; }
    // Numbers, ascending, of all footprints within kChartReachMetres of the place. The list is that
    // of the cell, so some are farther.
    [[nodiscard]] std::span<const std::uint32_t> near(glm::vec2 xz) const;
    // The highest top of those; far below the sea where there are none.
    [[nodiscard]] float highestNear(glm::vec2 xz) const { return tops_[cellOf(xz)]; }
    // Prefetches what these read for a place, on the chart or not.
    void fetch(glm::vec2 xz) const;

  private:
    [[nodiscard]] std::size_t cellOf(glm::vec2 xz) const;
    // Fills sand_ and highest_; fills starts_ and listed_.
    void measure(const PlaceKey& place);
    void list(std::span<const Footprint> footprints);

    // Corner of least x and z.
    glm::vec2 origin_{};
    // Width in x and z; 0 where the chart covers nothing.
    glm::vec2 extent_{};
    // Grid corners and cells in a row along x; rows follow one another in z.
    int corners_ = 0;
    int cells_ = 0;
    float highest_ = 0;
    std::vector<float> sand_;
    // Footprints of cell i: listed_[starts_[i]] to listed_[starts_[i + 1]].
    std::vector<std::uint32_t> starts_, listed_;
    std::vector<float> tops_;  // of each cell
};

// Made once per scene and constant afterwards: any thread may read it.
struct Obstacles {
    PlaceKey place;
    Region water;
    // Only rocks and stems that reach into the water of the fish.
    std::vector<Rock> rocks;
    std::vector<Stem> stems = {};
    // Chart of sand, rocks and stems, rocks first. An empty one covers nothing: then all are
    // tested.
    Chart chart = {};
};
// Whether test(rock) holds for a rock about a place (x, z) whose top is above a height. Tests at
// least all such rocks that come within kChartReachMetres of it; by the chart none that is not
// listed there.
template <class Test>
[[nodiscard]] bool anyRockNear(const Obstacles& obstacles,
                               glm::vec2 xz,
                               float heightMetres,
                               const Test& test) {
    if (!obstacles.chart.covers(xz)) return std::ranges::any_of(obstacles.rocks, test);
    if (obstacles.chart.highestNear(xz) < heightMetres) return false;
    for (const std::uint32_t i : obstacles.chart.near(xz)) {
        if (i >= obstacles.rocks.size()) break;  // stems come last
        if (test(obstacles.rocks[i])) return true;
    }
    return false;
}
// Gathers the obstacles of a place in the given water and charts them.
[[nodiscard]] Obstacles obstaclesOf(const PlaceKey& place, const Region& water);

}  // namespace aquarama::place
