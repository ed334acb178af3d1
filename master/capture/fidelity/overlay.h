// SPDX-License-Identifier: Apache-2.0
// Two ways laid over each other where they begin.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "master/capture/fidelity/trace.h"

namespace aquarama::fidelity {

// Of the nose, averaged over the beat that ends at the tick; radians, left positive.
[[nodiscard]] double headingAt(const Trace& trace, std::size_t tick, double beatTicks);
[[nodiscard]] double wrapped(double radians);  // to -pi .. pi

// Of the body frame's origin, body lengths.
[[nodiscard]] double pathLength(const Trace& trace, std::size_t from, std::size_t to);

// The replica's way laid over the fish's at one tick, by place and heading. Both are kept by
// reference.
class Overlay {
  public:
    Overlay(const Trace& fish, const Trace& replica, std::size_t start, double beatTicks);

    [[nodiscard]] glm::dvec3 at(std::size_t tick) const;  // the replica's place
    [[nodiscard]] std::vector<glm::dvec3> wayTo(std::size_t end) const;
    [[nodiscard]] double distanceAt(std::size_t tick) const;
    [[nodiscard]] double mostTo(std::size_t end) const;  // of the distances from the start on
    // Of the replica against the fish, radians.
    [[nodiscard]] double headingErrorAt(std::size_t tick, double beatTicks) const;

  private:
    const Trace& fish_;
    const Trace& replica_;
    std::size_t start_;
    double turn_;  // radians, from the replica's heading to the fish's
};

}  // namespace aquarama::fidelity
