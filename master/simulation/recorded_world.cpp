// SPDX-License-Identifier: Apache-2.0
#include "master/simulation/recorded_world.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

#include "common/base/log.h"

namespace aquarama::simulation {

// A recording begins and ends with a hash, so that even a short one can be compared.
RecordedWorld::RecordedWorld(LivingWorld& world, RecordingFile& file)
    : SimulationDecorator(world), living_(world), file_(file) {
    file_.add(wire::entryOf(now()));
}

RecordedWorld::~RecordedWorld() {
    file_.add(wire::endOf(now()));
}

void RecordedWorld::advance() {
    // Inputs are recorded with the tick at whose beginning they apply.
    for (const world::WorldInput& input : std::exchange(pending_, {})) {
        file_.add(wire::entryOf(recorded(world_.tick(), input)));
        world_.apply(input);
    }
    world_.advance();
    if (world_.tick().value % kTicksBetweenCheckpoints == 0) file_.add(wire::entryOf(now()));
    if (world_.tick().value % kTicksBetweenSaves == 0) file_.save(living_.world());
}

Playback::Playback(const wire::Recording& recording, LivingWorld& world)
    : recording_(recording), world_(world) {
    assert(world.tick() == Tick{});
    if (!recording.beginsWithSave)
        compare();
    else if (!beginAt(recording.saves.front()))
        throw Error(recording.source + ": cannot be played from its beginning by this build");
}

void Playback::goTo(Tick tick) {
    const auto& saves = recording_.saves;
    const auto behind = std::ranges::upper_bound(saves, tick, {}, &wire::RecordedSave::tick);
    for (auto save = behind; save != saves.begin() && std::prev(save)->tick > world_.tick();)
        if (beginAt(*--save)) break;
    while (world_.tick() < tick && !over()) advance();
}

bool Playback::beginAt(const wire::RecordedSave& save) {
    try {
        world_.restore(wire::readState(recording_, save), recording_.source);
    } catch (const Error& problem) {
        logWarning("{}", problem.what());
        return false;
    }
    const auto from = [&](const auto& list) {
        const auto found = std::ranges::lower_bound(
            list, save.tick, {}, [](const auto& entry) { return entry.tick; });
        return static_cast<std::size_t>(found - list.begin());
    };
    nextInput_ = from(recording_.inputs);
    nextCheckpoint_ = from(recording_.checkpoints);
    compare();
    return true;
}

// Same order as RecordedWorld::advance(): inputs first, then the tick.
void Playback::advance() {
    const auto& inputs = recording_.inputs;
    while (nextInput_ < inputs.size() && inputs[nextInput_].tick <= world_.tick())
        world_.apply(inputOf(inputs[nextInput_++]));
    world_.advance();
    compare();
}

// Compares with all checkpoints up to this tick, and with the end of the recording at its tick.
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
    // Only the first difference is kept: a world that differs once never comes back.
    if (hash != expected.hash && !difference_)
        difference_ = {expected.tick, expected.hash, hash, lastSame_};
    if (hash == expected.hash) lastSame_ = expected.tick;
}

ReplayedWorld::ReplayedWorld(const wire::Recording& recording,
                             LivingWorld& world,
                             Tick from,
                             std::function<void()> onEnd)
    : SimulationDecorator(world), playback_(recording, world), onEnd_(std::move(onEnd)) {
    assert(onEnd_ != nullptr);
    playback_.goTo(from);
}

void ReplayedWorld::advance() {
    playback_.advance();
    if (playback_.difference() && !std::exchange(toldOfDifference_, true))
        logWarning("from tick {} on the replay is another world than the recorded one",
                   playback_.difference()->tick.value);
    // The world may be advanced further; onEnd_ is called only once.
    if (playback_.over() && !std::exchange(ended_, true)) onEnd_();
}

void ReplayedWorld::apply(const world::WorldInput& /*input*/) {
    if (!std::exchange(toldOfInput_, true))
        logWarning("this is a replay: what visitors do does not reach its world");
}

namespace {

// One pair of functions for each kind of input.
wire::RecordedFood recordedOne(const world::DropFood& food) {
    return {food.position, food.pellets};
}
wire::RecordedSubmarine recordedOne(const world::MoveSubmarine& moved) {
    return {moved.position, moved.velocityMetresPerSecond};
}
Steering recordedOne(const Steering& steering) {
    return steering;
}
wire::RecordedClock recordedOne(const world::SetClock& clock) {
    return {clock.timeOfDay, clock.lengthSeconds};
}
WallHands recordedOne(const WallHands& hands) {
    return hands;
}
wire::RecordedDrawing recordedOne(const world::EnterDrawing& drawing) {
    return {drawing.fish, drawing.number, drawing.picture, drawing.aside};
}
wire::RecordedDeparture recordedOne(const world::LeaveDrawing& drawing) {
    return {drawing.fish};
}
wire::RecordedDay recordedOne(const world::SetDay& day) {
    return {day.timeOfDay, day.glideSeconds};
}
wire::RecordedRelease recordedOne(const world::ReleaseHunter& cue) {
    return {cue.species};
}
world::DropFood inputOfOne(const wire::RecordedFood& food) {
    return {food.position, food.pellets};
}
world::MoveSubmarine inputOfOne(const wire::RecordedSubmarine& moved) {
    return {moved.position, moved.velocityMetresPerSecond};
}
Steering inputOfOne(const Steering& steering) {
    return steering;
}
WallHands inputOfOne(const WallHands& hands) {
    return hands;
}
world::EnterDrawing inputOfOne(const wire::RecordedDrawing& drawing) {
    return {drawing.fish, drawing.number, drawing.picture, drawing.aside};
}
world::LeaveDrawing inputOfOne(const wire::RecordedDeparture& departure) {
    return {departure.fish};
}
world::SetClock inputOfOne(const wire::RecordedClock& clock) {
    return {clock.timeOfDay, clock.lengthSeconds};
}

world::SetDay inputOfOne(const wire::RecordedDay& day) {
    return {day.timeOfDay, day.glideSeconds};
}
world::ReleaseHunter inputOfOne(const wire::RecordedRelease& release) {
    return {release.species};
}

}  // namespace

wire::RecordedInput recorded(Tick tick, const world::WorldInput& input) {
    wire::RecordedInput recorded{tick, {}};
    std::visit([&](const auto& what) { recorded.input = recordedOne(what); }, input);
    return recorded;
}

world::WorldInput inputOf(const wire::RecordedInput& recorded) {
    return std::visit([](const auto& what) { return world::WorldInput{inputOfOne(what)}; },
                      recorded.input);
}

}  // namespace aquarama::simulation
