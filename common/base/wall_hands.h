// SPDX-License-Identifier: Apache-2.0
// Hands of visitors before the wall, as trackers see them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace aquarama {

inline constexpr std::size_t kMostWallHands = 16;  // at a time; more are left out
// Of the numbers of its point, metres.
inline constexpr float kMostWallHandMetres = 1000;

// One hand; `id` is its own for as long as it is there.
struct WallHand {
    std::uint32_t id = 0;
    glm::vec3 point{};  // of the screen, from the sweet spot in the axes of the wall frame, metres
    friend bool operator==(const WallHand&, const WallHand&) = default;
};

// All that there are. A state: it holds until the next, kTicksOfAHand at most.
using WallHands = std::vector<WallHand>;

}  // namespace aquarama
