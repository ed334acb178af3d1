// SPDX-License-Identifier: Apache-2.0
// Numbers the vertices of a cage whose faces are each cut into n x n pieces, so that faces share
// those on their borders.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/body/fish_body.h"

namespace aquarama::skin {

// Vertex numbers of one face, row by row: column i is at u = i / n, row j at v = j / n. Corners of
// the face are the cage's own vertices.
class FaceGrid {
  public:
    FaceGrid(const body::ControlCage& cage, int cuts);

    struct Location {
        std::uint32_t face = 0;
        float u = 0, v = 0;
    };

    [[nodiscard]] int cuts() const { return cuts_; }
    [[nodiscard]] std::uint32_t at(std::size_t face, int i, int j) const;
    // For each vertex a place where it lies, ordered by vertex.
    [[nodiscard]] const std::vector<Location>& locations() const { return locations_; }

  private:
    int cuts_;
    std::vector<std::uint32_t> numbers_;
    std::vector<Location> locations_;
};

}  // namespace aquarama::skin
