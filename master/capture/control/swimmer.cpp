// SPDX-License-Identifier: Apache-2.0
#include "master/capture/control/swimmer.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "master/capture/control/muscle_programs.h"

namespace aquarama {

namespace {

// Of the fish's own seconds.
constexpr double kHandover = 0.04;  // from one order's muscles to the next one's
constexpr double kFirstSecond = 1;  // the first beats from rest grow

}  // namespace

Swimmer::Swimmer(const Species& species, double stepSeconds)
    : fish_(makeBiomechanicalFish(species)),
      swim_(species.swim),
      stepSeconds_(stepSeconds),
      state_(stateAtRest(fish_)) {}

Swimmer::Swimmer(const Species& species)
    : Swimmer(species, longestStepSeconds(makeBiomechanicalFish(species))) {}

void Swimmer::give(const Order& order) {
    order_ = order;
    ownSecondsOfOrder_ = 0;
    musclesBefore_ = muscles_;
}

void Swimmer::advance(int steps) {
    for (int i = 0; i < steps; ++i) advanceOne();
}

void Swimmer::advanceOne() {
    muscles_ = mix(musclesBefore_, program(), std::min(1.0, ownSecondsOfOrder_ / kHandover));
    step(fish_, {.muscles = muscles_, .fins = {}}, stepSeconds_, state_);
    ++steps_;
    const double ownSeconds = stepSeconds_ * fish_.timeScale;
    ownSecondsOfOrder_ += ownSeconds;
    if (!swims()) return;
    ownSecondsSwum_ += ownSeconds;
    beat_ += stepSeconds_ * order_.gait.beatHertz;
    beat_ -= std::floor(beat_);
}

bool Swimmer::swims() const {
    switch (order_.controller) {
        case Controller::ForwardSwim:
        case Controller::Ascend:
        case Controller::Descend:
        case Controller::Balance:
            return true;
        case Controller::LeftTurn:
        case Controller::RightTurn:
        case Controller::Glide:
        case Controller::Brake:
        case Controller::Retreat:
            break;
    }
    return false;
}

MuscleActivation Swimmer::program() const {
    if (swims()) {
        const double grown = std::min(1.0, ownSecondsSwum_ / kFirstSecond);
        return beatAt(swim_, order_.gait.gain * grown, beat_);
    }
    if (order_.controller == Controller::LeftTurn) return bendLeft(order_.bend, ownSecondsOfOrder_);
    if (order_.controller == Controller::RightTurn)
        return mirrored(bendLeft(order_.bend, ownSecondsOfOrder_));
    return {};
}

}  // namespace aquarama
