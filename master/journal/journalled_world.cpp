// SPDX-License-Identifier: Apache-2.0
#include "master/journal/journalled_world.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <fstream>
#include <iterator>
#include <ranges>
#include <string>
#include <utility>

#include "common/base/amounts.h"
#include "common/base/boot_clock.h"
#include "common/base/counted.h"
#include "common/base/files.h"
#include "common/base/log.h"

namespace aquarama::journal {

namespace {

constexpr std::uint64_t kTicksBetweenHashes = 60;
constexpr std::uint64_t kTicksBetweenWarnings = 3600;

// Names the start of this machine, with which CLOCK_BOOTTIME begins anew.
std::string bootOf() {
    std::ifstream file("/proc/sys/kernel/random/boot_id");
    std::string boot;
    file >> boot;
    return boot;
}

wire::RecordedMoment momentAt(Tick tick) {
    static const std::string boot = bootOf();
    return {.tick = tick,
            .clockNs = static_cast<std::uint64_t>(bootNanoseconds()),
            .boot = boot,
            .unixSeconds = static_cast<std::uint64_t>(std::time(nullptr))};
}

// Puts the world at the newest save that is one of it. Of those that are not, one is told: mostly
// all are of another build.
bool restoreNewest(simulation::LivingWorld& world, const LastWorld& last) {
    std::string problem;
    const auto restores = [&](const auto& read, const std::string& source) {
        try {
            world.restore(read(), source);
            return true;
        } catch (const Error& error) {
            if (problem.empty()) problem = error.what();
            return false;
        }
    };
    const auto fromFile = [&](const std::filesystem::path& path) {
        return restores([&] { return readWhole(path, wire::kMostSavedBytes); }, path.string());
    };
    const auto fromRecording = [&](const wire::RecordedSave& save) {
        return restores([&] { return wire::readState(last.recording, save); },
                        last.recording.source);
    };
    const auto& saves = last.recording.saves;
    const bool isRestored = std::ranges::any_of(last.saves, fromFile) ||
                            std::any_of(saves.rbegin(), saves.rend(), fromRecording);
    if (!problem.empty())
        logWarning(
            "{}; {}", problem, isRestored ? "an earlier save is used" : "a new world begins");
    return isRestored;
}

// The last tick of which the journal knows. An input was written before its tick.
Tick lastKnown(const wire::Recording& recording, Tick restored) {
    Tick known = restored;
    if (recording.moment) known = std::max(known, recording.moment->tick);
    if (!recording.checkpoints.empty()) known = std::max(known, recording.checkpoints.back().tick);
    if (!recording.inputs.empty() && recording.inputs.back().tick.value > kTicksAhead)
        known = std::max(known, Tick{recording.inputs.back().tick.value - kTicksAhead});
    return known;
}

// Since a moment, by the clock of this machine; by that of the calendar where the machine was
// started anew. Zero where a clock has gone back.
double secondsSince(const wire::RecordedMoment& then) {
    const wire::RecordedMoment now = momentAt({});
    if (now.boot == then.boot)
        return now.clockNs < then.clockNs ? 0
                                          : static_cast<double>(now.clockNs - then.clockNs) * 1e-9;
    return now.unixSeconds < then.unixSeconds
               ? 0
               : static_cast<double>(now.unixSeconds - then.unixSeconds);
}

// The tick that is due now, by the clock.
Tick dueNow(const wire::Recording& recording, Tick restored, TimeAway timeAway) {
    const Tick known = lastKnown(recording, restored);
    if (timeAway == TimeAway::LeftOut || !recording.moment) return known;
    const wire::RecordedMoment& then = *recording.moment;
    if (then.boot != momentAt({}).boot) return known;
    const auto away = static_cast<std::uint64_t>(secondsSince(then) * kTicksPerSecond);
    return away > kMostTicksAway ? known : std::max(known, Tick{then.tick.value + away});
}

using Inputs = std::vector<wire::RecordedInput>;

// Advances to a tick, with the inputs before it, as far as time allows. Returns the first that is
// still ahead.
Inputs::const_iterator advanceTo(simulation::LivingWorld& world,
                                 Tick due,
                                 std::chrono::steady_clock::time_point latest,
                                 std::ranges::subrange<Inputs::const_iterator> inputs) {
    auto next = inputs.begin();
    while (world.tick() < due && std::chrono::steady_clock::now() < latest) {
        for (; next != inputs.end() && next->tick <= world.tick(); ++next)
            world.apply(simulation::inputOf(*next));
        world.advance();
    }
    return next;
}

}  // namespace

std::optional<std::vector<wire::RecordedInput>> goOn(simulation::LivingWorld& world,
                                                     const LastWorld& last,
                                                     TimeAway timeAway) {
    const auto begin = std::chrono::steady_clock::now();
    if (!restoreNewest(world, last)) return std::nullopt;
    const Tick restored = world.tick();
    const std::vector<wire::RecordedInput>& inputs = last.recording.inputs;
    const auto first = std::ranges::lower_bound(inputs, restored, {}, &wire::RecordedInput::tick);
    const Tick due = dueNow(last.recording, restored, timeAway);
    // What was shown comes first: it is not shown again.
    const Tick known = std::min(lastKnown(last.recording, restored), due);
    const auto lived = advanceTo(world, known, begin + kMostTimeKnown, {first, inputs.end()});
    const auto next = advanceTo(world, due, begin + kMostTimeAway, {lived, inputs.end()});
    logInfo("the world goes on at {} from its save at {}, with {}",
            timeOf(world.tick()),
            timeOf(restored),
            counted(static_cast<std::uint64_t>(next - first), "input"));
    if (world.tick() < due)
        logWarning("the world is {} behind its clock and goes on from here",
                   counted(due.value - world.tick().value, "tick"));
    return std::vector<wire::RecordedInput>(next, inputs.end());
}

JournalledWorld::JournalledWorld(std::unique_ptr<simulation::LivingWorld> world,
                                 std::unique_ptr<Journal> journal,
                                 const wire::AssetBundle& assets,
                                 const std::vector<wire::RecordedInput>& ahead)
    : SimulationDecorator(*world),
      living_(std::move(world)),
      journal_(std::move(journal)),
      relay_(wire::beginningOf(assets, wire::Repertoires::Named)) {
    for (const wire::RecordedInput& input : ahead) applyAt(input.tick, simulation::inputOf(input));
}

void JournalledWorld::put(Tick tick, const world::WorldInput& input, bool isOwn) {
    const wire::Packet entry = wire::entryOf(simulation::recorded(tick, input));
    ahead_.push_back({tick, journal_->add(entry), isOwn, input});
    relay_.add(entry);
}

void JournalledWorld::beginFollowed() {
    std::vector<wire::Packet> ahead;
    for (const Ahead& input : ahead_)
        ahead.push_back(wire::entryOf(simulation::recorded(input.tick, input.input)));
    relay_.begin(living_->world(), ahead);
}

// Inputs keep their order.
void JournalledWorld::apply(const world::WorldInput& input) {
    const Tick soonest{world_.tick().value + (isRunning_ ? kTicksAhead : 0)};
    put(ahead_.empty() ? soonest : std::max(soonest, ahead_.back().tick), input, true);
    if (!isRunning_) applyDue();
}

void JournalledWorld::advance() {
    isRunning_ = true;
    applyDue();
    world_.advance();
    const Tick tick = world_.tick();
    if (tick.value % kTicksBetweenHashes == 0) noteNow();
    relay_.reach(tick);
    journal_->save(living_->world());
}

// The hash, and the time by the clock.
void JournalledWorld::noteNow() {
    const Tick tick = world_.tick();
    note(wire::entryOf(wire::RecordedHash{tick, world_.hash()}));
    wire::RecordedMoment moment = momentAt(tick);
    moment.lateInputs = lateInputs_;
    note(wire::entryOf(moment));
}

void JournalledWorld::note(const wire::Packet& entry) {
    journal_->note(entry);
    relay_.add(entry);
}

void JournalledWorld::applyDue() {
    while (!ahead_.empty() && ahead_.front().tick <= world_.tick()) {
        const Ahead& next = ahead_.front();
        if (isRunning_ && next.isOwn && !journal_->isOnDisk(next.number)) noteLate();
        world_.apply(next.input);
        ahead_.pop_front();
    }
}

void JournalledWorld::noteLate() {
    ++lateInputs_;
    const Tick now = world_.tick();
    const bool isFirst = !lateAt_ || now.value >= lateAt_->value + kTicksBetweenWarnings;
    journal_->report()->inputWasLate(isFirst);
    if (!isFirst) return;
    lateAt_ = now;
    logWarning("what a visitor did took effect before the journal's disk had it");
}

std::unique_ptr<simulation::LivingWorld> emptyWorld(const simulation::Assets& assets) {
    world::WorldOptions options = simulation::worldOptionsOf(assets);
    options.scene.livedSeconds = 0;
    return std::make_unique<simulation::LivingWorld>(options);
}

std::unique_ptr<JournalledWorld> makeJournalled(const std::filesystem::path& folder,
                                                const simulation::Assets& assets,
                                                TimeAway timeAway) {
    std::unique_ptr<simulation::LivingWorld> world;
    std::optional<std::vector<wire::RecordedInput>> ahead;
    double awaySeconds = 0;
    if (const auto last = lastWorldIn(folder, assets.bytes)) {
        world = emptyWorld(assets);
        if (last->recording.moment) awaySeconds = secondsSince(*last->recording.moment);
        ahead = goOn(*world, *last, timeAway);
    }
    if (!ahead)
        world = std::make_unique<simulation::LivingWorld>(simulation::worldOptionsOf(assets));
    auto journal = std::make_unique<Journal>(folder, assets.bytes, world->world());
    if (ahead) journal->report()->wentOn(world->tick(), awaySeconds);
    return std::make_unique<JournalledWorld>(std::move(world),
                                             std::move(journal),
                                             assets.bytes,
                                             ahead.value_or(std::vector<wire::RecordedInput>{}));
}

}  // namespace aquarama::journal
