// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/perceive/spatial_grid.h"

#include <algorithm>

namespace aquarama {

namespace {

int cellsAcross(float halfExtent, float cellMetres) {
    return std::max(1, static_cast<int>(2 * halfExtent / cellMetres) + 1);
}

}  // namespace

SpatialGrid::SpatialGrid(const Region& water, float cellMetres, std::size_t most)
    : origin_(water.centre - water.halfExtent),
      cellMetres_(cellMetres),
      cellsPerMetre_(1 / cellMetres),
      cells_{cellsAcross(water.halfExtent.x, cellMetres),
             cellsAcross(water.halfExtent.y, cellMetres),
             cellsAcross(water.halfExtent.z, cellMetres)},
      starts_(std::size_t(cells_.x) * std::size_t(cells_.y) * std::size_t(cells_.z) + 1),
      cellOfPoint_(most),
      x_(most),
      y_(most),
      z_(most),
      index_(most) {}

SpatialGrid::Cell SpatialGrid::cellOf(glm::vec3 point) const {
    const glm::vec3 at = (point - origin_) * cellsPerMetre_;
    return {clampedCell(at.x, cells_.x), clampedCell(at.y, cells_.y), clampedCell(at.z, cells_.z)};
}

void SpatialGrid::rebuild(const Points& points, std::span<const std::uint32_t> chosen) {
    std::fill(starts_.begin(), starts_.end(), 0U);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        const std::uint32_t point = chosen[i];
        const Cell cell = cellOf({points.x[point], points.y[point], points.z[point]});
        cellOfPoint_[i] =
            static_cast<std::uint32_t>((cell.z * cells_.y + cell.y) * cells_.x + cell.x);
        ++starts_[cellOfPoint_[i]];
    }
    std::uint32_t end = 0;
    for (std::uint32_t& start : starts_) start = end += start;
    // Filled from the back, each start moves down to where its cell begins.
    for (std::size_t i = chosen.size(); i-- > 0;) {
        const std::uint32_t slot = --starts_[cellOfPoint_[i]];
        x_[slot] = points.x[chosen[i]];
        y_[slot] = points.y[chosen[i]];
        z_[slot] = points.z[chosen[i]];
        index_[slot] = chosen[i];
    }
}

SpatialGrid::Candidates SpatialGrid::run(int row, int firstCell, int lastCell) const {
    const auto cells = starts_.begin() + row;
    const std::size_t first = cells[firstCell];
    const std::size_t count = cells[lastCell + 1] - first;
    return {{x_.data() + first, count},
            {y_.data() + first, count},
            {z_.data() + first, count},
            {index_.data() + first, count}};
}

std::size_t SpatialGrid::bytes() const {
    return sizeof(std::uint32_t) * (starts_.size() + cellOfPoint_.size() + index_.size()) +
           sizeof(float) * (x_.size() + y_.size() + z_.size());
}

}  // namespace aquarama
