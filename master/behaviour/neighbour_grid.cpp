// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/neighbour_grid.h"

#include <algorithm>

namespace aquarama {

namespace {

int cellsAcross(float halfExtent, float cellMetres) {
    return std::max(1, static_cast<int>(2 * halfExtent / cellMetres) + 1);
}

}  // namespace

NeighbourGrid::NeighbourGrid(const Region& water, float cellMetres, std::size_t fish)
    : origin_(water.centre - water.halfExtent),
      cellMetres_(cellMetres),
      cellsPerMetre_(1 / cellMetres),
      cells_{cellsAcross(water.halfExtent.x, cellMetres),
             cellsAcross(water.halfExtent.y, cellMetres),
             cellsAcross(water.halfExtent.z, cellMetres)},
      starts_(static_cast<std::size_t>(cells_.x * cells_.y * cells_.z) + 1),
      cellOfFish_(fish),
      x_(fish),
      y_(fish),
      z_(fish),
      fish_(fish) {}

NeighbourGrid::Cell NeighbourGrid::cellOf(glm::vec3 point) const {
    const glm::vec3 at = (point - origin_) * cellsPerMetre_;
    return {clampedCell(at.x, cells_.x), clampedCell(at.y, cells_.y), clampedCell(at.z, cells_.z)};
}

void NeighbourGrid::rebuild(const SchoolView& view) {
    std::fill(starts_.begin(), starts_.end(), 0U);
    const std::size_t fish = view.size();
    for (std::size_t i = 0; i < fish; ++i) {
        const Cell cell = cellOf(view.position(i));
        cellOfFish_[i] =
            static_cast<std::uint32_t>((cell.z * cells_.y + cell.y) * cells_.x + cell.x);
        ++starts_[cellOfFish_[i]];
    }
    std::uint32_t end = 0;
    for (std::uint32_t& start : starts_) start = end += start;
    // Filled from the back, each start moves down to where its cell begins.
    for (std::size_t i = fish; i-- > 0;) {
        const std::uint32_t slot = --starts_[cellOfFish_[i]];
        x_[slot] = view.x[i];
        y_[slot] = view.y[i];
        z_[slot] = view.z[i];
        fish_[slot] = static_cast<std::uint32_t>(i);
    }
}

NeighbourGrid::Candidates NeighbourGrid::run(int row, int firstCell, int lastCell) const {
    const std::size_t first = starts_[static_cast<std::size_t>(row + firstCell)];
    const std::size_t count = starts_[static_cast<std::size_t>(row + lastCell) + 1] - first;
    return {{x_.data() + first, count},
            {y_.data() + first, count},
            {z_.data() + first, count},
            {fish_.data() + first, count}};
}

std::size_t NeighbourGrid::bytes() const {
    return sizeof(std::uint32_t) * (starts_.size() + cellOfFish_.size() + fish_.size()) +
           sizeof(float) * (x_.size() + y_.size() + z_.size());
}

}  // namespace aquarama
