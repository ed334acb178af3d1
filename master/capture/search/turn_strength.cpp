// SPDX-License-Identifier: Apache-2.0
#include "master/capture/search/turn_strength.h"

#include <numbers>

#include "master/capture/compile/turn.h"

namespace aquarama {

namespace {

constexpr int kHalvings = 8;

double meanDegrees(const Species& species, const SteadySwimming& entry, const Bend& bend) {
    double sum = 0;
    for (int i = 0; i < kOnsets; ++i)
        sum += turnRadians(
            recordTurn(species, entry, Controller::LeftTurn, bend, i * kPhases / kOnsets));
    return sum / kOnsets * 180 / std::numbers::pi;
}

// The harder the bend the further the turn, so halving finds it.
Bend fitting(const Species& species, const SteadySwimming& entry, Bend bend, double degrees) {
    double weak = 0;
    double strong = 1;
    for (int i = 0; i < kHalvings; ++i) {
        bend.strength = (weak + strong) / 2;
        (meanDegrees(species, entry, bend) < degrees ? weak : strong) = bend.strength;
    }
    return bend;
}

}  // namespace

Turn withFittingStrengths(const Species& species) {
    const SteadySwimming entry = swimUntilSteady(species, species.swim.medium);
    return {.gradual = fitting(species, entry, species.turn.gradual, kGradualDegrees),
            .sharp = fitting(species, entry, species.turn.sharp, kSharpDegrees)};
}

}  // namespace aquarama
