// SPDX-License-Identifier: Apache-2.0
// Who or what is near: points sorted into the cells of a uniform grid, so that a search reads a few
// short runs of memory.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "common/place/place.h"

namespace aquarama {

struct Points {  // metres
    std::span<const float> x, y, z;
};

class SpatialGrid {
  public:
    // Room for `most` points. Those outside `water` are kept in the border cells; they are found
    // all the same.
    SpatialGrid(const Region& water, float cellMetres, std::size_t most);

    // Of all points, those at these ascending indices. Counting sort: in each cell they stand in
    // the order of their index. Allocates nothing.
    void rebuild(const Points& points, std::span<const std::uint32_t> chosen);

    struct Candidates {  // one run of cells, structure of arrays
        std::span<const float> x, y, z;
        std::span<const std::uint32_t> index;
    };
    // Calls visit(Candidates) for rows of cells, from the point outwards, that together hold every
    // point within sqrt(reachSquared). The visitor may lower reachSquared as it finds what it
    // sought.
    template <class Visit>
    void visitAround(glm::vec3 point, const float& reachSquared, Visit&& visit) const {
        const glm::vec3 at = (point - origin_) * cellsPerMetre_;  // in cells
        const Cell centre = cellOf(point);
        const auto row = [&](int y, int z) {
            if (y < 0 || y >= cells_.y || z < 0 || z >= cells_.z) return;
            const float dy = outside(at.y, centre.y, y);
            const float dz = outside(at.z, centre.z, z);
            const float left =
                reachSquared * kSlack - (dy * dy + dz * dz) * cellMetres_ * cellMetres_;
            if (left < 0) return;
            const float halfWidth = std::sqrt(left) * cellsPerMetre_;
            const int first = clampedCell(at.x - halfWidth, cells_.x);
            const int last = clampedCell(at.x + halfWidth, cells_.x);
            visit(run((z * cells_.y + y) * cells_.x, first, last));
        };
        row(centre.y, centre.z);
        const int cells = 1 + static_cast<int>(std::sqrt(reachSquared) * cellsPerMetre_);
        for (int ring = 1; ring <= cells; ++ring) {
            for (int i = -ring; i < ring;
                 ++i) {  // the four sides of a square, each without its end
                row(centre.y + i, centre.z - ring);
                row(centre.y + ring, centre.z + i);
                row(centre.y - i, centre.z + ring);
                row(centre.y - ring, centre.z - i);
            }
        }
    }

    [[nodiscard]] std::size_t bytes() const;

  private:
    struct Cell {
        int x, y, z;
    };
    static constexpr float kSlack = 1.001F;  // more than rounding can take off a reach

    // Border cells reach outwards without end.
    [[nodiscard]] static int clampedCell(float cell, int cells) {
        return static_cast<int>(std::clamp(cell, 0.0F, static_cast<float>(cells - 1)));
    }
    // How far a point in cell `own` is from another, in cells.
    [[nodiscard]] static float outside(float at, int own, int other) {
        return other > own   ? static_cast<float>(other) - at
               : other < own ? at - static_cast<float>(other + 1)
                             : 0.0F;
    }
    [[nodiscard]] Cell cellOf(glm::vec3 point) const;
    [[nodiscard]] Candidates run(int row, int firstCell, int lastCell) const;

    glm::vec3 origin_{};
    float cellMetres_;
    float cellsPerMetre_;
    Cell cells_{};
    std::vector<std::uint32_t> starts_;  // first point of each cell; one more at the end
    std::vector<std::uint32_t> cellOfPoint_;
    std::vector<float> x_, y_, z_;
    std::vector<std::uint32_t> index_;
};

}  // namespace aquarama
