// SPDX-License-Identifier: Apache-2.0
// What each fish's mind asks of its motor: which way it wants to go, how fast and how urgently
// (the motor controller parameters of the paper, section 5.1).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "common/units/ids.h"

namespace aquarama::fish {

// A fish thinks every eighth tick (Reynolds 2006), each in its turn.
inline constexpr std::uint64_t kTicksBetweenThoughts = 8;
[[nodiscard]] constexpr bool thinksAt(Tick tick, std::size_t fish) {
    return (tick.value + fish) % kTicksBetweenThoughts == 0;
}

struct Course {
    glm::vec3 direction{1, 0, 0};  // unit vector
    float speed = 0;               // body lengths a second; under a quarter of slow: hover
    float urgency = 0;             // 0 in the open; from 1 on it turns sharply
    // Whether another swim pattern for a while is welcome; set for all routines alike, after them.
    bool openToChange = false;
};

using Courses = std::vector<Course>;  // of all fish

}  // namespace aquarama::fish
