// SPDX-License-Identifier: Apache-2.0
#include "master/capture/compile/recording.h"

#include <cassert>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "common/units/error.h"
#include "master/capture/control/muscle_programs.h"
#include "master/capture/dynamics/body_frame.h"

namespace aquarama {

namespace {

// By then the pose repeats itself from cycle to cycle within 1e-5 body lengths.
constexpr int kWarmUpCycles = 24;
// "Straight again" for the end of a turn, and how long it may take: the fish's own seconds.
constexpr double kStraightBodyLengths = 0.03;
constexpr double kLongestRecovery = 4;

using MuscleProgram = std::function<MuscleActivation(double seconds)>;

class Simulation {
  public:
    Simulation(const BiomechanicalFish& fish, MuscleProgram muscles, double stepSeconds)
        : fish_(fish),
          muscles_(std::move(muscles)),
          stepSeconds_(stepSeconds),
          state_(stateAtRest(fish)) {}

    void advance(int steps) {
        for (int i = 0; i < steps; ++i)
            step(fish_,
                 {.muscles = muscles_(stepSeconds_ * static_cast<double>(steps_++)), .fins = {}},
                 stepSeconds_,
                 state_);
    }
    [[nodiscard]] const NodeVectors& pose() const { return state_.positions; }

  private:
    const BiomechanicalFish& fish_;
    MuscleProgram muscles_;
    double stepSeconds_;
    FishState state_;
    std::int64_t steps_ = 0;
};

// So many steps to a phase that none is longer than the longest that swims well.
int stepsPerPhase(const BiomechanicalFish& fish, double periodSeconds) {
    return static_cast<int>(std::ceil(periodSeconds / kPhases / longestStepSeconds(fish) - 1e-9));
}

Recording recordCycle(const BiomechanicalFish& fish,
                      double beatHertz,
                      const MuscleProgram& muscles,
                      const Progress& progress) {
    Recording recording{.periodSeconds = 1 / beatHertz, .poses = {}};
    const int steps = stepsPerPhase(fish, recording.periodSeconds);
    Simulation simulation(fish, muscles, recording.periodSeconds / (kPhases * steps));
    for (int cycle = 0; cycle < kWarmUpCycles; ++cycle) {
        simulation.advance(kPhases * steps);
        progress((cycle + 1.0) / (kWarmUpCycles + 1));
    }
    recording.poses.push_back(simulation.pose());
    for (int phase = 0; phase < kPhases; ++phase) {
        simulation.advance(steps);
        recording.poses.push_back(simulation.pose());
    }
    progress(1);
    return recording;
}

double bendOf(const NodeVectors& pose, const NodeVectors& straight) {
    const NodeVectors bent = inBodyFrame(pose);
    double most = 0;
    for (std::size_t i = 0; i < bent.size(); ++i)
        most = std::max(most, glm::distance(bent.at(i), straight.at(i)));
    return most;
}

Recording recordTurn(const Species& species,
                     const Bend& bend,
                     const BiomechanicalFish& fish,
                     const Progress& progress) {
    const double beatSeconds = 1 / species.swim.medium.beatHertz;
    const double stepSeconds = beatSeconds / (kPhases * stepsPerPhase(fish, beatSeconds));
    const auto beatSteps = static_cast<int>(std::lround(beatSeconds / stepSeconds));
    const double onset = kWarmUpCycles * beatSeconds;
    Simulation simulation(
        fish, [&](double seconds) { return turnLeft(species, bend, onset, seconds); }, stepSeconds);
    for (int cycle = 0; cycle < kWarmUpCycles; ++cycle) {
        simulation.advance(beatSteps);
        progress((cycle + 1.0) / (kWarmUpCycles + 4));
    }

    std::vector<NodeVectors> poses{simulation.pose()};
    const NodeVectors straight = inBodyFrame(fish.restPositions);
    const double muscleSteps = secondsOf(bend, species) / stepSeconds;
    const double mostSteps = kLongestRecovery / fish.timeScale / stepSeconds;
    while (static_cast<double>(poses.size()) < muscleSteps || (poses.size() - 1) % kPhases != 0 ||
           bendOf(poses.back(), straight) > kStraightBodyLengths) {
        if (static_cast<double>(poses.size()) > mostSteps)
            throw Error(species.name +
                        ": after a turn the fish does not become straight; "
                        "change `turn` or `tissue` in its species file");
        simulation.advance(1);
        poses.push_back(simulation.pose());
    }
    progress(1);

    const std::size_t stride = (poses.size() - 1) / kPhases;
    Recording recording{.periodSeconds = stepSeconds * static_cast<double>(poses.size() - 1),
                        .playsToEnd = true,
                        .poses = {}};
    for (std::size_t i = 0; i < poses.size(); i += stride) recording.poses.push_back(poses[i]);
    return recording;
}

}  // namespace

Recording record(const Species& species, Action action, const Progress& progress) {
    const BiomechanicalFish fish = makeBiomechanicalFish(species);
    const auto forward = [&](const Gait& gait) {
        return recordCycle(
            fish,
            gait.beatHertz,
            [&](double seconds) { return swim(species, gait, seconds); },
            progress);
    };
    switch (action) {
        case Action::ForwardSlow:
            return forward(species.swim.slow);
        case Action::ForwardMedium:
            return forward(species.swim.medium);
        case Action::ForwardFast:
            return forward(species.swim.fast);
        case Action::TurnLeftGradual:
            return recordTurn(species, species.turn.gradual, fish, progress);
        case Action::TurnLeftSharp:
            return recordTurn(species, species.turn.sharp, fish, progress);
        case Action::TurnRightGradual:
        case Action::TurnRightSharp:
        case Action::Glide:
            break;
    }
    assert(false &&
           "right turns are mirrored from the left ones, a glide is made of the mean pose");
    return {};
}

}  // namespace aquarama
