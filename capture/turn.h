// SPDX-License-Identifier: Apache-2.0
// Turns in the simulation, from their onset in steady swimming until the fish is straight again,
// and by how much they change the course. Angles are radians, left positive.
#pragma once

#include <array>
#include <numbers>
#include <vector>

#include "capture/speed_response.h"

namespace aquarama::capture {

// How far a fish rolls into a turn at most.
inline constexpr double kBankRadians = 12 * std::numbers::pi / 180;

// How much more the left muscles pull on a tight curve (Order::curve). Over all species its radius
// is 1.7 to 3.5 body lengths by the tail, and 0.6 to 0.8 where fins row.
inline constexpr double kTightCurve = 0.4;
// A gait on a tight curve to the left, with the roll into it.
[[nodiscard]] inline Order tightCurve(const config::Gait& gait) {
    return {.controller = Controller::ForwardSwim,
            .gait = gait,
            .curve = kTightCurve,
            .bankRadians = kBankRadians};
}

// A turn is over when its muscles are relaxed and no nodal point is farther than this from its
// place in the straight fish, in the body frame.
inline constexpr double kStraightBodyLengths = 0.03;

// A left or right turn out of the steady swimming `entry`, begun at a phase (0 to kPhases - 1) of
// the beat. Throws Error, naming the species, when the fish does not become straight within four of
// its own seconds.
[[nodiscard]] RecordedCycle recordTurn(const config::Species& species,
                                       const SteadySwimming& entry,
                                       Controller leftOrRight,
                                       const config::Bend& bend,
                                       int onsetPhase);

// The angle from the course before the turn to the heading of the body frame at its end.
[[nodiscard]] double turnRadians(const RecordedCycle& turn);

// Phases of the beat, evenly spaced, at which a turn is tried. It divides kPhases.
inline constexpr int kOnsets = 8;

// Left turns with one bend out of one gait, begun at each of the kOnsets phases.
struct TurnSpread {
    motion::Action turn = motion::Action::TurnLeftGradual;
    motion::Action entry = motion::Action::ForwardMedium;
    std::array<double, kOnsets> radians{};  // begun at phase i / kOnsets of the beat
    // The least, mean and greatest of `radians`.
    [[nodiscard]] double least() const;
    [[nodiscard]] double mean() const;
    [[nodiscard]] double most() const;
};

// Gradual and sharp left turns, each entered from slow, medium and fast swimming: 48 simulations.
// Throws as recordTurn() and swimUntilSteady() do.
[[nodiscard]] std::vector<TurnSpread> surveyTurns(const config::Species& species);

// Left turns with one bend, begun in the steady swimming of each entry: first by entry and then by
// kRecordedPhases phases of the beat, evenly spaced from 0 on. Each lasts `seconds`; then the fish
// swims on at the medium gait.
inline constexpr int kRecordedPhases = 4;
[[nodiscard]] std::vector<EnteredTurn> recordEnteredTurns(
    const config::Species& species,
    const std::vector<const SteadySwimming*>& entries,
    const config::Bend& bend,
    double seconds);

// Fast starts in the simulation.

// How long the bend of each fast start lasts, from small to large, as shares of the species'.
inline constexpr std::array kBendShares{0.5, 0.75, 1.0};

// A left fast start out of rest, until the tissue is relaxed.
[[nodiscard]] EnteredTurn recordStart(const config::Species& species, double bendShare);
// Those begun in the steady swimming of each entry: first by entry and then by kRecordedPhases
// phases of the beat. They last as long as that out of rest.
[[nodiscard]] std::vector<EnteredTurn> recordEnteredStarts(
    const config::Species& species,
    const std::vector<const SteadySwimming*>& entries,
    double bendShare);

// The turn to capture, entered from medium swimming: of the turns begun at kOnsets phases, the one
// whose angle is nearest to their mean.
[[nodiscard]] RecordedCycle recordTypicalLeftTurn(const config::Species& species,
                                                  const SteadySwimming& medium,
                                                  const config::Bend& bend);

}  // namespace aquarama::capture
