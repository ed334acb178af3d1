// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/climate.h"

#include <algorithm>
#include <cassert>

namespace aquarama::surroundings {

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

// Share of the surface light that a metre of water takes away. A straight line in place of the
// exponential law, because the master uses no libm.
constexpr float kLostPerMetre = 0.02F;

}  // namespace

Chart::Chart(const place::PlaceKey& place,
             const place::Region& water,
             std::span<const Footprint> footprints)
    : origin_{water.centre.x - water.halfExtent.x - kAboutMetres,
              water.centre.z - water.halfExtent.z - kAboutMetres},
      extent_{2 * (water.halfExtent.x + kAboutMetres), 2 * (water.halfExtent.z + kAboutMetres)} {
    measure(place);
    list(footprints);
}

// An open sea has a flat floor: no heights are stored, only one.
void Chart::measure(const place::PlaceKey& place) {
    if (place.kind == config::PlaceKind::OpenSea) {
        highest_ = -place::kOpenSeaFloorDepthMetres;
        return;
    }
    // One corner more than cells, so that every place has four corners around it.
    corners_ = steps(extent_.x, kChartStepMetres) + 1;
    const int rows = steps(extent_.y, kChartStepMetres) + 1;
    for (int z = 0; z < rows; ++z)
        for (int x = 0; x < corners_; ++x)
            sand_.push_back(
                place::floorHeight(place,
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
        for (std::uint32_t i = 0; i < footprints.size(); ++i) {
            const float reach = footprints[i].radiusMetres + kChartReachMetres;
            if (squaredDistanceToCell(footprints[i].xz, least) < reach * reach)
                listed_.push_back(i);
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

std::span<const std::uint32_t> Chart::near(glm::vec2 xz) const {
    assert(covers(xz));
    const glm::vec2 at = (xz - origin_) * (1 / kCellMetres);
    const auto cell =
        static_cast<std::size_t>(static_cast<int>(at.y) * cells_ + static_cast<int>(at.x));
    return std::span(listed_).subspan(starts_[cell], starts_[cell + 1] - starts_[cell]);
}

Climate climateOf(const config::Scene& scene) {
    return {scene.day,
            static_cast<float>(scene.water.surfaceCelsius),
            static_cast<float>(scene.water.celsiusPerMetre)};
}

float lightAt(const Climate& /*climate*/, float daylight, float y) {
    return daylight * std::max(0.0F, 1 + kLostPerMetre * std::min(y, 0.0F));
}

float celsiusAt(const Climate& climate, float y) {
    return climate.surfaceCelsius - climate.celsiusPerMetre * std::min(y, 0.0F);
}

}  // namespace aquarama::surroundings
