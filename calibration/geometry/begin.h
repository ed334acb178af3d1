// SPDX-License-Identifier: Apache-2.0
// Finds the camera with which the solve begins, by what it sees of the hall as the rig describes
// it.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include <glm/vec2.hpp>

#include "calibration/geometry/solved_hall.h"
#include "calibration/geometry/ties.h"
#include "common/config/rig.h"
#include "common/wall/wall.h"

namespace aquarama::geometry {

// A camera that was found. `loss`: the mean loss of its ties, where a hundredth of the picture's
// width is an error of one.
struct Sighted {
    Device camera;
    double loss = 0;
};

// The camera with the least loss. `order[i]`: the channel of the rig that hangs where channel i of
// the scan is seen. Nothing where the camera sees too little.
[[nodiscard]] std::optional<Sighted> bestSighted(const std::vector<Tie>& ties,
                                                 std::uint32_t camera,
                                                 const wall::Wall& wall,
                                                 glm::ivec2 size,
                                                 const std::vector<std::size_t>& order);

// Two channels whose cables are exchanged: nothing unless the exchange explains the first camera's
// ties far better than the order of the rig does, whose loss is `loss`.
[[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> swappedPair(
    const config::Rig& rig,
    const wall::Wall& wall,
    const std::vector<Tie>& ties,
    glm::ivec2 size,
    double loss);

}  // namespace aquarama::geometry
