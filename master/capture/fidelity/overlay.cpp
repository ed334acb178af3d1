// SPDX-License-Identifier: Apache-2.0
#include "master/capture/fidelity/overlay.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

namespace aquarama::fidelity {

double headingAt(const Trace& trace, std::size_t tick, double beatTicks) {
    glm::dvec3 sum{};
    double left = beatTicks;
    for (std::size_t at = tick; left > 0; --at, left -= 1) {
        sum += std::min(left, 1.0) * trace[at].frame.worldFromBody[0];
        if (at == 0) break;
    }
    return std::atan2(-sum.z, sum.x);
}

double wrapped(double radians) {
    return std::remainder(radians, 2 * std::numbers::pi);
}

double pathLength(const Trace& trace, std::size_t from, std::size_t to) {
    double length = 0;
    for (std::size_t tick = from; tick < to; ++tick)
        length += glm::distance(trace[tick].frame.origin, trace[tick + 1].frame.origin);
    return length;
}

Overlay::Overlay(const Trace& fish, const Trace& replica, std::size_t start, double beatTicks)
    : fish_(fish),
      replica_(replica),
      start_(start),
      turn_(headingAt(fish, start, beatTicks) - headingAt(replica, start, beatTicks)) {}

glm::dvec3 Overlay::at(std::size_t tick) const {
    const glm::dvec3 way = replica_[tick].frame.origin - replica_[start_].frame.origin;
    return fish_[start_].frame.origin + glm::angleAxis(turn_, glm::dvec3(0, 1, 0)) * way;
}

std::vector<glm::dvec3> Overlay::wayTo(std::size_t end) const {
    std::vector<glm::dvec3> way;
    for (std::size_t tick = start_; tick <= end; ++tick) way.push_back(at(tick));
    return way;
}

double Overlay::distanceAt(std::size_t tick) const {
    return glm::distance(fish_[tick].frame.origin, at(tick));
}

double Overlay::mostTo(std::size_t end) const {
    double most = 0;
    for (std::size_t tick = start_; tick <= end; ++tick) most = std::max(most, distanceAt(tick));
    return most;
}

double Overlay::headingErrorAt(std::size_t tick, double beatTicks) const {
    return wrapped(headingAt(replica_, tick, beatTicks) + turn_ -
                   headingAt(fish_, tick, beatTicks));
}

}  // namespace aquarama::fidelity
