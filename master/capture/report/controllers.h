// SPDX-License-Identifier: Apache-2.0
// Trials of the motor controllers: the biomechanical fish after an order, as the figure of the nine
// controllers shows it.
#pragma once

#include <vector>

#include "common/config/species.h"
#include "master/capture/biomechanical_fish.h"
#include "master/capture/swimmer.h"

namespace aquarama::report {

// The fish at one instant.
struct Moment {
    double seconds = 0;            // since the order
    capture::NodeVectors nodes{};  // body lengths; the origin is where the fish was at the order
    capture::PectoralFins fins;
};

// What a fish does after an order.
struct ControllerTrial {
    std::vector<Moment> moments;  // kMoments + 1, evenly in time, the first at the order
    // Mean speeds along the body axis before the order and after the last moment, body lengths a
    // second; negative is backward.
    double speedBefore = 0, speedAfter = 0;
};

inline constexpr int kMoments = 240;  // intervals between the moments

// The origin of the body frame.
[[nodiscard]] glm::dvec3 middleOf(const capture::NodeVectors& nodes);

// Trials of `seconds` after the order. Each simulates a fish of its own. swimmingThen(): after
// runUpBeats beats of medium swimming; rolledThen(): from rest, rolled about the body axis, the
// right side up for a positive angle; restingThen(): from rest.
[[nodiscard]] ControllerTrial swimmingThen(const config::Species& species,
                                           const capture::Order& order,
                                           double seconds,
                                           double runUpBeats);
[[nodiscard]] ControllerTrial rolledThen(const config::Species& species,
                                         double rollRadians,
                                         const capture::Order& order,
                                         double seconds);
[[nodiscard]] ControllerTrial restingThen(const config::Species& species,
                                          const capture::Order& order,
                                          double seconds);

}  // namespace aquarama::report
