// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/school_stream.h"

#include <algorithm>
#include <cassert>
#include <memory>
#include <numeric>
#include <utility>

#include "common/school/keyframe.h"
#include "master/conductor/simulation_thread.h"

namespace aquarama::conductor {
namespace {

constexpr std::uint64_t kTicksBetweenBases = 64;
constexpr std::size_t kBases = 2;
constexpr std::uint64_t kTicksBetweenHashes = 30;
// A keyframe for a node is older than any frame that is still to be drawn.
constexpr std::uint64_t kTicksUndrawn = 2 * SnapshotBuffer::kKept;
static_assert(kTicksUndrawn < kTicksBetweenBases);
// Of blobs for nodes that ask.
constexpr std::uint64_t kTicksAlike = 6, kTicksKept = 600;
constexpr std::size_t kMostAskedForBytes = std::size_t{256} << 20U;

// A world that names no commands has none: all its fish are placed.
const motion::MotorCommands& commandsOf(const Snapshot& snapshot, motion::MotorCommands& none) {
    if (snapshot.commands.action.size() == snapshot.fish.size()) return snapshot.commands;
    none.resize(snapshot.fish.size());
    return none;
}

std::vector<std::uint32_t> skinsIn(const Snapshot& snapshot) {
    std::vector<std::uint32_t> skins(snapshot.fish.size());
    std::ranges::transform(snapshot.fish, skins.begin(), &motion::FishRecord::skin);
    return skins;
}

}  // namespace

void SchoolStream::begin(std::vector<school::RecordedRates> rates) {
    ++stream_;
    rates_ = std::move(rates);
    newest_.reset();
    sent_.reset();
    bases_.clear();
    steps_.clear();
    askedFor_.clear();
}

void SchoolStream::add(const Snapshot& snapshot) {
    motion::MotorCommands none;
    const motion::MotorCommands& commands = commandsOf(snapshot, none);
    if (newest_) {
        assert(snapshot.tick.value == newest_->value + 1);
        steps_.push_back(
            {snapshot.tick,
             school::encodeStep(snapshot.tick, commands, placedIn(snapshot), known_, memory_)});
        if (snapshot.tick.value % kTicksBetweenHashes == 0)
            steps_.back().hash = school::hashOf(snapshot.fish, commands);
    } else {
        known_ = commands;
        skins_ = skinsIn(snapshot);
        memory_ = school::makeStepMemory(rates_, snapshot.fish.size());
    }
    newest_ = snapshot.tick;
    if (bases_.empty() || snapshot.tick.value >= bases_.back().tick.value + kTicksBetweenBases)
        keepBase(snapshot, commands);
}

void SchoolStream::keepBase(const Snapshot& snapshot, const motion::MotorCommands& commands) {
    bases_.push_back(
        {snapshot.tick, school::encodeKeyframe(snapshot.tick, snapshot.fish, commands, memory_)});
    if (bases_.size() <= kBases) return;
    bases_.pop_front();
    while (!steps_.empty() && steps_.front().tick <= bases_.front().tick) steps_.pop_front();
}

// Those that the world names, each once, and those that wear another skin than before.
std::vector<school::PlacedFish> SchoolStream::placedIn(const Snapshot& snapshot) {
    std::vector<std::uint32_t> fish = snapshot.placed;
    if (snapshot.commands.action.size() != snapshot.fish.size()) {
        fish.resize(snapshot.fish.size());
        std::iota(fish.begin(), fish.end(), 0U);
    }
    for (std::uint32_t i = 0; i < snapshot.fish.size(); ++i)
        if (std::exchange(skins_[i], snapshot.fish[i].skin) != snapshot.fish[i].skin)
            fish.push_back(i);
    std::ranges::sort(fish);
    fish.erase(std::ranges::unique(fish).begin(), fish.end());
    std::vector<school::PlacedFish> placed;
    for (const std::uint32_t i : fish) placed.push_back({i, snapshot.fish[i]});
    return placed;
}

wire::SchoolPart SchoolStream::upTo(Tick tick) {
    assert(newest_ && tick <= *newest_);
    const bool follows = sent_ && *sent_ >= bases_.front().tick;
    wire::SchoolPart part = follows ? wire::SchoolPart{stream_, {}, between(*sent_, tick)}
                                    : fromBase({std::max<std::uint64_t>(tick.value, 1) - 1}, tick);
    sent_ = std::max(sent_.value_or(tick), tick);
    return part;
}

// Nodes that ask at about the same time are given the same one.
std::optional<Digest> SchoolStream::keyframe() {
    if (!newest_) return std::nullopt;
    if (!askedFor_.empty() && newest_->value < askedFor_.back().newest.value + kTicksAlike)
        return askedFor_.back().digest;
    forgetOld();
    const std::uint64_t latest = std::max(newest_->value, kTicksUndrawn) - kTicksUndrawn;
    auto blob = std::make_shared<const net::ByteVector>(
        wire::encodeSchoolPart(fromBase({latest}, *newest_)));
    askedFor_.push_back({*newest_, digestOf(*blob), blob});
    return askedFor_.back().digest;
}

void SchoolStream::forgetOld() {
    std::size_t bytes = 0;
    for (const AskedFor& one : askedFor_) bytes += one.blob->size();
    while (!askedFor_.empty() && (bytes > kMostAskedForBytes ||
                                  askedFor_.front().newest.value + kTicksKept < newest_->value)) {
        bytes -= askedFor_.front().blob->size();
        askedFor_.pop_front();
    }
}

net::Blob SchoolStream::blob(const Digest& digest) const {
    const auto found = std::ranges::find(askedFor_, digest, &AskedFor::digest);
    return found == askedFor_.end() ? nullptr : found->blob;
}

wire::SchoolPart SchoolStream::fromBase(Tick latest, Tick to) const {
    const auto isEarly = [&](const Base& base) { return base.tick <= latest; };
    const auto newest = std::find_if(bases_.rbegin(), bases_.rend(), isEarly);
    const Base& base = newest == bases_.rend() ? bases_.front() : *newest;
    return {stream_, base.keyframe, between(base.tick, to)};
}

std::vector<wire::SchoolStep> SchoolStream::between(Tick after, Tick to) const {
    std::vector<wire::SchoolStep> steps;
    for (const wire::SchoolStep& step : steps_)
        if (step.tick > after && step.tick <= to) steps.push_back(step);
    return steps;
}

}  // namespace aquarama::conductor
