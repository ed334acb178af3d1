// SPDX-License-Identifier: Apache-2.0
// What each fish's mind asks of its motor: which way it wants to go, how fast and how urgently
// (the motor controller parameters of the paper, section 5.1).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "common/units/ids.h"

namespace aquarama {

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

struct Courses {  // structure of arrays, as Course
    std::vector<float> directionX, directionY, directionZ;
    std::vector<float> speed;
    std::vector<float> urgency;
    std::vector<std::uint8_t> openToChange;

    void resize(std::size_t fish) {
        for (auto* values : {&directionX, &directionY, &directionZ, &speed, &urgency})
            values->resize(fish);
        openToChange.resize(fish);
    }
    [[nodiscard]] glm::vec3 direction(std::size_t fish) const {
        return {directionX[fish], directionY[fish], directionZ[fish]};
    }
    void set(std::size_t fish, const Course& course) {
        directionX[fish] = course.direction.x;
        directionY[fish] = course.direction.y;
        directionZ[fish] = course.direction.z;
        speed[fish] = course.speed;
        urgency[fish] = course.urgency;
        openToChange[fish] = course.openToChange ? 1 : 0;
    }
};

}  // namespace aquarama
