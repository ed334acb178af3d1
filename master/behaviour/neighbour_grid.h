// SPDX-License-Identifier: Apache-2.0
// Who is near: fish sorted into the cells of a uniform grid, so that a search reads a few short
// runs of memory.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "common/place/place.h"
#include "master/behaviour/school_view.h"

namespace aquarama {

class NeighbourGrid {
  public:
    // Fish outside `water` are kept in the border cells; they are found all the same.
    NeighbourGrid(const Region& water, float cellMetres, std::size_t fish);

    // Counting sort: in each cell fish stand in the order of their index. Allocates nothing.
    void rebuild(const SchoolView& view);

    struct Candidates {  // one run of cells, structure of arrays
        std::span<const float> x, y, z;
        std::span<const std::uint32_t> fish;
    };
    // Calls visit(Candidates) for each row of the (2 reach + 1)^3 cells about a point; that holds
    // every fish nearer than reach * cellMetres.
    template <class Visit>
    void visitAround(glm::vec3 point, int reach, Visit&& visit) const {
        const Cell centre = cellOf(point);
        const int firstX = centre.x > reach ? centre.x - reach : 0;
        const int lastX = centre.x + reach < cells_.x ? centre.x + reach : cells_.x - 1;
        for (int z = centre.z - reach; z <= centre.z + reach; ++z) {
            if (z < 0 || z >= cells_.z) continue;
            for (int y = centre.y - reach; y <= centre.y + reach; ++y) {
                if (y < 0 || y >= cells_.y) continue;
                const int row = (z * cells_.y + y) * cells_.x;
                visit(run(row + firstX, row + lastX));
            }
        }
    }

    [[nodiscard]] float cellMetres() const { return cellMetres_; }
    [[nodiscard]] std::size_t bytes() const;

  private:
    struct Cell {
        int x, y, z;
    };
    [[nodiscard]] Cell cellOf(glm::vec3 point) const;
    [[nodiscard]] Candidates run(int firstCell, int lastCell) const;

    glm::vec3 origin_{};
    float cellMetres_;
    float cellsPerMetre_;
    Cell cells_{};
    std::vector<std::uint32_t> starts_;  // first fish of each cell; one more at the end
    std::vector<std::uint32_t> cellOfFish_;
    std::vector<float> x_, y_, z_;
    std::vector<std::uint32_t> fish_;
};

}  // namespace aquarama
