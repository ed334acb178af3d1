// SPDX-License-Identifier: Apache-2.0
#include "master/capture/search/turn_strength.h"

#include <numbers>

#include "master/capture/compile/turn.h"

namespace aquarama::search {

namespace {

constexpr int kHalvings = 8;

double meanDegrees(const config::Species& species,
                   const capture::SteadySwimming& entry,
                   const config::Bend& bend) {
    double sum = 0;
    for (int i = 0; i < capture::kOnsets; ++i)
        sum += capture::turnRadians(capture::recordTurn(species,
                                                        entry,
                                                        capture::Controller::LeftTurn,
                                                        bend,
                                                        i * motion::kPhases / capture::kOnsets));
    return sum / capture::kOnsets * 180 / std::numbers::pi;
}

// The harder the bend the further the turn, so halving finds it.
config::Bend fitting(const config::Species& species,
                     const capture::SteadySwimming& entry,
                     config::Bend bend,
                     double degrees) {
    double weak = 0;
    double strong = 1;
    for (int i = 0; i < kHalvings; ++i) {
        bend.strength = (weak + strong) / 2;
        (meanDegrees(species, entry, bend) < degrees ? weak : strong) = bend.strength;
    }
    return bend;
}

}  // namespace

config::Turn withFittingStrengths(const config::Species& species) {
    const capture::SteadySwimming entry = capture::swimUntilSteady(species, species.swim.medium);
    return {.gradual = fitting(species, entry, species.turn.gradual, kGradualDegrees),
            .sharp = fitting(species, entry, species.turn.sharp, kSharpDegrees)};
}

}  // namespace aquarama::search
