// SPDX-License-Identifier: Apache-2.0
// Turns as the simulation swims them, from their onset in steady swimming until the fish is
// straight again, and how far they go.
#pragma once

#include <array>
#include <vector>

#include "master/capture/speed_response.h"

namespace aquarama::capture {

// A turn is over when its muscles are relaxed and no nodal point is further than this from where
// it is in a straight fish, in the body frame.
inline constexpr double kStraightBodyLengths = 0.03;

// Left or right, begun at a phase (0 to kPhases - 1) of the beat. Throws Error, naming the species,
// when the fish does not become straight within four of its own seconds.
[[nodiscard]] RecordedCycle recordTurn(const config::Species& species,
                                       const SteadySwimming& entry,
                                       Controller leftOrRight,
                                       const config::Bend& bend,
                                       int onsetPhase);

// From the course before to the heading after; left positive.
[[nodiscard]] double turnRadians(const RecordedCycle& turn);

inline constexpr int kOnsets = 8;  // evenly over the beat

// Left turns of one bend out of one gait.
struct TurnSpread {
    motion::Action turn = motion::Action::TurnLeftGradual;
    motion::Action entry = motion::Action::ForwardMedium;
    std::array<double, kOnsets> radians{};  // begun at phase i / kOnsets of the beat
    [[nodiscard]] double least() const;
    [[nodiscard]] double mean() const;
    [[nodiscard]] double most() const;
};

// Gradual and sharp, each entered from slow, medium and fast swimming.
[[nodiscard]] std::vector<TurnSpread> surveyTurns(const config::Species& species);

// The one to capture, entered from medium swimming: of the turns begun at kOnsets phases, that
// which goes nearest to their mean.
[[nodiscard]] RecordedCycle recordTypicalLeftTurn(const config::Species& species,
                                                  const SteadySwimming& medium,
                                                  const config::Bend& bend);

}  // namespace aquarama::capture
