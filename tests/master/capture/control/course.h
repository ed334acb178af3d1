// SPDX-License-Identifier: Apache-2.0
// Where a swimmer goes, and how it lies in the water.
#pragma once

#include <cmath>

#include <glm/geometric.hpp>

#include "master/capture/control/swimmer.h"

namespace aquarama {

inline void advanceSeconds(Swimmer& swimmer, double seconds) {
    swimmer.advance(static_cast<int>(std::lround(seconds / swimmer.stepSeconds())));
}

inline glm::dvec3 centreOf(const Swimmer& swimmer) {
    const NodeVectors& x = swimmer.state().positions;
    return (x[5] + x[6] + x[7] + x[8]) / 4.0;
}

struct Course {
    double speed = 0;           // body lengths a second
    double headingRadians = 0;  // of the path, left positive
};

// Over the next so many seconds.
inline Course courseOver(Swimmer& swimmer, double seconds) {
    const glm::dvec3 from = centreOf(swimmer);
    const double start = swimmer.seconds();
    advanceSeconds(swimmer, seconds);
    const glm::dvec3 way = centreOf(swimmer) - from;
    return {.speed = glm::length(way) / (swimmer.seconds() - start),
            .headingRadians = std::atan2(-way.z, way.x)};
}

}  // namespace aquarama
