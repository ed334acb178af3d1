// SPDX-License-Identifier: Apache-2.0
#include "master/capture/search/gait_trial.h"

#include <cmath>
#include <cstdint>
#include <future>

#include "master/capture/compile/compile_segment.h"
#include "master/capture/compile/steady_swimming.h"
#include "master/capture/control/muscle_programs.h"

namespace aquarama::search {

namespace {

// Speed takes dozens of beats to settle, the wave only a few.
constexpr double kFlyingStart = 0.62;  // body lengths a beat, as most fish go
constexpr int kWarmUpBeats = 12;

GaitFigures figuresOf(const config::Gait& gait, const capture::RecordedCycle& beat) {
    const motion::ActionSegment segment = capture::compileForward(beat);
    return {gait.beatHertz, capture::measure(segment), capture::bodyWave(segment)};
}

capture::RecordedCycle quickBeat(const config::Species& species, const config::Gait& gait) {
    const capture::BiomechanicalFish fish = capture::makeBiomechanicalFish(species);
    const double period = 1 / gait.beatHertz;
    const int steps = static_cast<int>(
        std::ceil(period / motion::kPhases / capture::longestStepSeconds(fish) - 1e-9));
    const double stepSeconds = period / (motion::kPhases * steps);
    capture::FishState state = capture::stateAtRest(fish);
    for (glm::dvec3& velocity : state.velocities) velocity.x = kFlyingStart * gait.beatHertz;
    std::int64_t done = 0;
    const auto advance = [&](int count) {
        for (int i = 0; i < count; ++i)
            capture::step(
                fish,
                {.muscles = capture::swim(species, gait, stepSeconds * static_cast<double>(done++)),
                 .fins = {}},
                stepSeconds,
                state);
    };
    advance(kWarmUpBeats * motion::kPhases * steps);
    capture::RecordedCycle beat{.periodSeconds = period, .poses = {state.positions}};
    for (int phase = 0; phase < motion::kPhases; ++phase) {
        advance(steps);
        beat.poses.push_back(state.positions);
    }
    return beat;
}

}  // namespace

GaitFigures steadyFigures(const config::Species& species, const config::Gait& gait) {
    return figuresOf(gait, capture::swimUntilSteady(species, gait).beat);
}

ForwardFigures quickFigures(const config::Species& species) {
    const auto start = [&](const config::Gait& gait) {
        return std::async(std::launch::async,
                          [&species, &gait] { return figuresOf(gait, quickBeat(species, gait)); });
    };
    auto slow = start(species.swim.slow);
    auto medium = start(species.swim.medium);
    auto fast = start(species.swim.fast);
    return {slow.get(), medium.get(), fast.get()};
}

}  // namespace aquarama::search
