// SPDX-License-Identifier: Apache-2.0
// Fish in conditions in which everything that can move does, and their momentum.
#pragma once

#include <cmath>

#include "capture/biomechanical_fish.h"
#include "tests/support/scad.h"

namespace aquarama::capture {

inline BiomechanicalFish inVacuum() {
    BiomechanicalFish fish = makeBiomechanicalFish(test::scad());
    for (WettedFace& face : fish.faces) face.drag = 0;
    fish.finDrag = 0;
    return fish;
}

inline FishState disturbed(const BiomechanicalFish& fish) {
    FishState state = stateAtRest(fish);
    for (std::size_t i = 0; i < state.positions.size(); ++i) {
        const auto k = static_cast<double>(i);
        state.positions.at(i) +=
            0.01 * glm::dvec3(std::sin(3 * k), std::sin(5 * k + 1), std::sin(7 * k + 2));
        state.velocities.at(i) = 0.5 * glm::dvec3(std::cos(2 * k), std::cos(k), std::sin(4 * k));
    }
    return state;
}

// In masses of the fish times body lengths a second.
inline glm::dvec3 momentumOf(const BiomechanicalFish& fish, const FishState& state) {
    glm::dvec3 momentum{};
    for (std::size_t i = 0; i < state.velocities.size(); ++i)
        momentum += fish.masses.at(i) * state.velocities.at(i);
    return momentum;
}

}  // namespace aquarama::capture
