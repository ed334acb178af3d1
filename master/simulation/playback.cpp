// SPDX-License-Identifier: Apache-2.0
#include "master/simulation/playback.h"

#include <utility>

#include "common/units/log.h"
#include "master/simulation/inputs.h"

namespace aquarama::simulation {

Playback::Playback(const wire::Recording& recording, conductor::Simulation& world)
    : recording_(recording), world_(world) {
    compare();
}

void Playback::advance() {
    const auto& inputs = recording_.inputs;
    while (nextInput_ < inputs.size() && inputs[nextInput_].tick <= world_.tick())
        world_.apply(inputOf(inputs[nextInput_++]));
    world_.advance();
    compare();
}

void Playback::compare() {
    const auto& checkpoints = recording_.checkpoints;
    while (nextCheckpoint_ < checkpoints.size() &&
           checkpoints[nextCheckpoint_].tick <= world_.tick())
        compareWith(checkpoints[nextCheckpoint_++]);
    if (recording_.end && recording_.end->tick == world_.tick()) compareWith(*recording_.end);
}

void Playback::compareWith(const wire::RecordedHash& expected) {
    ++compared_;
    const std::uint64_t hash = world_.hash();
    if (hash != expected.hash && !difference_)
        difference_ = {expected.tick, expected.hash, hash, lastSame_};
    if (hash == expected.hash) lastSame_ = expected.tick;
}

ReplayedWorld::ReplayedWorld(const wire::Recording& recording,
                             conductor::Simulation& world,
                             std::function<void()> onEnd)
    : SimulationDecorator(world), playback_(recording, world), onEnd_(std::move(onEnd)) {}

void ReplayedWorld::advance() {
    playback_.advance();
    if (playback_.difference() && !std::exchange(toldOfDifference_, true))
        logWarning("from tick {} on the replay is another world than the recorded one",
                   playback_.difference()->tick.value);
    if (playback_.over() && !std::exchange(ended_, true)) onEnd_();
}

void ReplayedWorld::apply(const world::WorldInput& /*input*/) {
    if (!std::exchange(toldOfInput_, true))
        logWarning("this is a replay: what visitors do does not reach its world");
}

}  // namespace aquarama::simulation
