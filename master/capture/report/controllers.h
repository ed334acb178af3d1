// SPDX-License-Identifier: Apache-2.0
// What the dynamic fish does after an order, as the sheet of controllers shows it.
#pragma once

#include <vector>

#include "common/config/species.h"
#include "master/capture/biomechanical_fish.h"
#include "master/capture/swimmer.h"

namespace aquarama::report {

// What is kept of a fish at an instant.
struct Moment {
    double seconds = 0;
    capture::NodeVectors nodes{};
    capture::PectoralFins fins;
};

// From the order on, evenly in time; seen from where the fish was when it came.
struct ControllerTrial {
    std::vector<Moment> moments;             // kMoments + 1
    double speedBefore = 0, speedAfter = 0;  // along the body, backward is negative
};

inline constexpr int kMoments = 240;

[[nodiscard]] glm::dvec3 middleOf(const capture::NodeVectors& nodes);

// After so many beats of medium swimming; from rest, rolled to its left; from rest.
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
