// SPDX-License-Identifier: Apache-2.0
// Which species are in each cell of the fishes' grid: a fish among its own alone need not look for
// others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "master/behaviour/perceive/spatial_grid.h"

namespace aquarama::behaviour {

class KindsAbout {
  public:
    explicit KindsAbout(const SpatialGrid& grid);

    void clear();
    // Of the fish of a bucket, once it is sorted; from any thread.
    void note(const SpatialGrid& grid, std::size_t bucket, std::span<const std::uint8_t> kinds);

    // Whether cells [from, to] may hold fish of other kinds than `own`.
    [[nodiscard]] bool mayHoldOthers(const SpatialGrid::Cell& from,
                                     const SpatialGrid::Cell& to,
                                     std::uint8_t own) const;
    // The same of a row of cells, to the cell; [first, last] are cells of the whole grid.
    [[nodiscard]] bool rowHoldsOthers(std::size_t first, std::size_t last, std::uint8_t own) const;

    [[nodiscard]] std::size_t bytes() const;

  private:
    [[nodiscard]] std::size_t blockOf(int x, int y, int z) const;

    SpatialGrid::Cell cells_;
    SpatialGrid::Cell blocks_;
    std::vector<std::uint8_t> kindOfCell_;     // kEmpty, kMixed or the kind of all its fish
    std::vector<std::uint64_t> kindsOfBlock_;  // a bit for each kind
};

}  // namespace aquarama::behaviour
