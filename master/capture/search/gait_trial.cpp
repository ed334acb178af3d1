// SPDX-License-Identifier: Apache-2.0
#include "master/capture/search/gait_trial.h"

#include <cmath>
#include <cstdint>
#include <future>

#include "master/capture/compile/compile_segment.h"
#include "master/capture/compile/steady_swimming.h"
#include "master/capture/control/muscle_programs.h"

namespace aquarama {

namespace {

// Speed takes dozens of beats to settle, the wave only a few.
constexpr double kFlyingStart = 0.62;  // body lengths a beat, as most fish go
constexpr int kWarmUpBeats = 12;

GaitFigures figuresOf(const Gait& gait, const Recording& beat) {
    const ActionSegment segment = compileForward(beat);
    return {gait.beatHertz, measure(segment), bodyWave(segment)};
}

Recording quickBeat(const Species& species, const Gait& gait) {
    const BiomechanicalFish fish = makeBiomechanicalFish(species);
    const double period = 1 / gait.beatHertz;
    const int steps =
        static_cast<int>(std::ceil(period / kPhases / longestStepSeconds(fish) - 1e-9));
    const double stepSeconds = period / (kPhases * steps);
    FishState state = stateAtRest(fish);
    for (glm::dvec3& velocity : state.velocities) velocity.x = kFlyingStart * gait.beatHertz;
    std::int64_t done = 0;
    const auto advance = [&](int count) {
        for (int i = 0; i < count; ++i)
            step(fish,
                 {.muscles = swim(species, gait, stepSeconds * static_cast<double>(done++)),
                  .fins = {}},
                 stepSeconds,
                 state);
    };
    advance(kWarmUpBeats * kPhases * steps);
    Recording beat{.periodSeconds = period, .poses = {state.positions}};
    for (int phase = 0; phase < kPhases; ++phase) {
        advance(steps);
        beat.poses.push_back(state.positions);
    }
    return beat;
}

}  // namespace

GaitFigures steadyFigures(const Species& species, const Gait& gait) {
    return figuresOf(gait, swimUntilSteady(species, gait).beat);
}

ForwardFigures quickFigures(const Species& species) {
    const auto start = [&](const Gait& gait) {
        return std::async(std::launch::async,
                          [&species, &gait] { return figuresOf(gait, quickBeat(species, gait)); });
    };
    auto slow = start(species.swim.slow);
    auto medium = start(species.swim.medium);
    auto fast = start(species.swim.fast);
    return {slow.get(), medium.get(), fast.get()};
}

}  // namespace aquarama
