// SPDX-License-Identifier: Apache-2.0
#include "common/place/obstacles.h"

#include <algorithm>
#include <cassert>
#include <limits>

namespace aquarama::place {

namespace {

// Margin of the chart around the water, and the width of a cell of its lists.
constexpr float kAboutMetres = 1.5F;
constexpr float kCellMetres = 1.0F;

// Cells of width `step` that cover a length.
int steps(float metres, float step) {
    return static_cast<int>(metres / step) + 1;
}

// In plan, from a point to the nearest point of a cell; 0 inside.
float squaredDistanceToCell(glm::vec2 point, glm::vec2 least) {
    const float dx = point.x - std::clamp(point.x, least.x, least.x + kCellMetres);
    const float dz = point.y - std::clamp(point.y, least.y, least.y + kCellMetres);
    return dx * dx + dz * dz;
}

float distanceToWater(const Region& water, glm::vec3 point) {
    const glm::vec3 from = point - water.centre;
    const glm::vec3 nearest{std::clamp(from.x, -water.halfExtent.x, water.halfExtent.x),
                            std::clamp(from.y, -water.halfExtent.y, water.halfExtent.y),
                            std::clamp(from.z, -water.halfExtent.z, water.halfExtent.z)};
    return lengthOf(from - nearest);
}

// The kelp whose push reaches into the water.
std::vector<Stem> stemsIn(const PlaceKey& key, const Region& water) {
    std::vector<Stem> stems;
    for (const Plant& plant : plantsOf(key)) {
        const float top = plant.root.y + plant.heightMetres;
        const float height = std::clamp(water.centre.y, plant.root.y, top);
        const glm::vec3 nearest{plant.root.x, height, plant.root.z};
        if (plant.kind == PlantKind::Kelp && distanceToWater(water, nearest) < kStemReachMetres)
            stems.push_back({{plant.root.x, plant.root.z}, top});
    }
    return stems;
}

// Footprints enlarged to where the push begins.
Chart chartOf(const Obstacles& obstacles) {
    std::vector<Chart::Footprint> footprints;
    for (const Rock& rock : obstacles.rocks)
        footprints.push_back({{rock.centre.x, rock.centre.z},
                              rock.radiusMetres + kRockReachMetres,
                              rock.centre.y + rock.radiusMetres});
    for (const Stem& stem : obstacles.stems)
        footprints.push_back({stem.foot, kStemReachMetres, stem.topMetres});
    return {obstacles.place, obstacles.water, footprints};
}

}  // namespace

Chart::Chart(const PlaceKey& key, const Region& water, std::span<const Footprint> footprints)
    : origin_{water.centre.x - water.halfExtent.x - kAboutMetres,
              water.centre.z - water.halfExtent.z - kAboutMetres},
      extent_{2 * (water.halfExtent.x + kAboutMetres), 2 * (water.halfExtent.z + kAboutMetres)} {
    measure(key);
    list(footprints);
}

// An open sea has a flat floor: no heights are stored, only one.
void Chart::measure(const PlaceKey& key) {
    if (key.kind == config::PlaceKind::OpenSea) {
        highest_ = -kOpenSeaFloorDepthMetres;
        return;
    }
    // One corner more than cells, so that every place has four corners around it.
    corners_ = steps(extent_.x, kChartStepMetres) + 1;
    const int rows = steps(extent_.y, kChartStepMetres) + 1;
    for (int z = 0; z < rows; ++z)
        for (int x = 0; x < corners_; ++x)
            sand_.push_back(floorHeight(key,
                                        {origin_.x + static_cast<float>(x) * kChartStepMetres,
                                         origin_.y + static_cast<float>(z) * kChartStepMetres}));
    highest_ = *std::ranges::max_element(sand_);
}

// O(cells x footprints), once per scene. Each cell lists the obstacles whose circle, enlarged by
// the reach, meets it.
void Chart::list(std::span<const Footprint> footprints) {
    cells_ = steps(extent_.x, kCellMetres);
    const int rows = steps(extent_.y, kCellMetres);
    for (int cell = 0; cell < cells_ * rows; ++cell) {
        starts_.push_back(static_cast<std::uint32_t>(listed_.size()));
        const int row = cell / cells_;
        const glm::vec2 least{origin_.x + static_cast<float>(cell % cells_) * kCellMetres,
                              origin_.y + static_cast<float>(row) * kCellMetres};
        tops_.push_back(std::numeric_limits<float>::lowest());
        for (std::uint32_t i = 0; i < footprints.size(); ++i) {
            const float reach = footprints[i].radiusMetres + kChartReachMetres;
            if (squaredDistanceToCell(footprints[i].xz, least) >= reach * reach) continue;
            listed_.push_back(i);
            tops_.back() = std::max(tops_.back(), footprints[i].topMetres);
        }
    }
    starts_.push_back(static_cast<std::uint32_t>(listed_.size()));
}

// Bilinear interpolation between the four corners of the cell.
float Chart::sand(glm::vec2 xz) const {
    assert(sand_.empty() || covers(xz));
    if (sand_.empty()) return highest_;
    const glm::vec2 at = (xz - origin_) * (1 / kChartStepMetres);
    const int x = static_cast<int>(at.x);
    const int z = static_cast<int>(at.y);
    const float u = at.x - static_cast<float>(x);
    const float v = at.y - static_cast<float>(z);
    const auto corner = sand_.begin() + std::ptrdiff_t{z} * corners_ + x;
    const float near = corner[0] + (corner[1] - corner[0]) * u;
    const float far = corner[corners_] + (corner[corners_ + 1] - corner[corners_]) * u;
    return near + (far - near) * v;
}

std::size_t Chart::cellOf(glm::vec2 xz) const {
    assert(covers(xz));
    const glm::vec2 at = (xz - origin_) * (1 / kCellMetres);
    return static_cast<std::size_t>(static_cast<int>(at.y) * cells_ + static_cast<int>(at.x));
}

void Chart::fetch(glm::vec2 xz) const {
    if (!covers(xz)) return;
    const std::size_t cell = cellOf(xz);
    __builtin_prefetch(&tops_[cell]);
    __builtin_prefetch(&starts_[cell]);
    if (sand_.empty()) return;
    const glm::vec2 at = (xz - origin_) * (1 / kChartStepMetres);
    const auto corner =
        static_cast<std::size_t>(static_cast<int>(at.y) * corners_ + static_cast<int>(at.x));
    __builtin_prefetch(&sand_[corner]);
    __builtin_prefetch(&sand_[corner + static_cast<std::size_t>(corners_)]);
}

std::span<const std::uint32_t> Chart::near(glm::vec2 xz) const {
    const std::size_t cell = cellOf(xz);
    return std::span(listed_).subspan(starts_[cell], starts_[cell + 1] - starts_[cell]);
}

Obstacles obstaclesOf(const PlaceKey& key, const Region& water) {
    Obstacles obstacles{key, water, {}};
    for (const Rock& rock : rocksOf(key)) {
        const float reach = rock.radiusMetres + kRockReachMetres;
        if (distanceToWater(water, rock.centre) < reach) obstacles.rocks.push_back(rock);
    }
    obstacles.stems = stemsIn(key, water);
    obstacles.chart = chartOf(obstacles);
    return obstacles;
}

}  // namespace aquarama::place
