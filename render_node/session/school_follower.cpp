// SPDX-License-Identifier: Apache-2.0
#include "render_node/session/school_follower.h"

#include <algorithm>
#include <chrono>
#include <span>
#include <utility>

#include "common/base/log.h"

namespace aquarama::session {
namespace {

// As many frames as the render thread may still want.
constexpr std::size_t kMostWaiting = 8;
// Steps are kept for a keyframe that is older than the newest frame; about four seconds.
constexpr std::size_t kMostSteps = 256;
constexpr net::Duration kBetweenRequests = std::chrono::milliseconds(250);

}  // namespace

void SchoolFollower::use(std::uint32_t look, std::shared_ptr<school::SchoolMotion> motion) {
    constexpr std::size_t kMostLooks = 2;  // that is shown, and the next
    motions_[look] = std::move(motion);
    while (motions_.size() > kMostLooks) motions_.erase(motions_.begin());
}

void SchoolFollower::forget() {
    enter(0);
    motions_.clear();
}

void SchoolFollower::enter(std::uint64_t stream) {
    stream_ = stream;
    motion_.reset();
    follows_.reset();
    steps_.clear();
    waiting_.clear();
    isMissing_ = isWrong_ = false;
    assembly_.reset();
}

void SchoolFollower::take(wire::CodedState coded, net::Moment arrival) {
    if (coded.school.stream != stream_) enter(coded.school.stream);
    if (motion_ == nullptr) {
        const auto found = motions_.find(coded.frame.show.look);
        if (found != motions_.end()) motion_ = found->second;
    }
    keep(coded.school);
    if (!follows_ && !coded.school.keyframe.empty()) load(coded.school);
    if (!follows_) lose();
    const auto isSame = [&](const Waiting& one) { return one.frame.frame == coded.frame.frame; };
    if (std::ranges::any_of(waiting_, isSame)) return;
    if (waiting_.size() == kMostWaiting) waiting_.pop_front();
    waiting_.push_back({std::move(coded.frame), arrival});
    std::ranges::stable_sort(waiting_, {}, [](const Waiting& one) { return one.frame.frame; });
}

void SchoolFollower::keep(const wire::SchoolPart& part) {
    for (const wire::SchoolStep& step : part.steps) steps_.emplace(step.tick, step);
    while (steps_.size() > kMostSteps) steps_.erase(steps_.begin());
}

void SchoolFollower::load(const wire::SchoolPart& part) {
    if (motion_ == nullptr) return;
    auto keyframe = school::decodeKeyframe(part.keyframe, motion_->fish());
    if (!keyframe) {
        if (!std::exchange(isRefused_, true))
            logError(
                "the master's keyframe is not of the fish of this look; use one version of master "
                "and node");
        return;
    }
    follows_ = std::move(keyframe);
    recent_.clear();
    recent_.remember(follows_->school);
    isMissing_ = isWrong_ = isRefused_ = false;
}

void SchoolFollower::take(const v1::Keyframe& keyframe) {
    if (!isMissing_ || assembly_) return;
    assembly_.emplace(wire::digestIn(keyframe.digest()));
    lastAsked_ = {};  // for its first chunk, at once
}

void SchoolFollower::take(const v1::BlobChunk& chunk) {
    if (!assembly_ || wire::digestIn(chunk.digest()) != assembly_->digest()) return;
    if (!assembly_->take(chunk.offset(), chunk.total(), std::as_bytes(std::span{chunk.content()})))
        return;
    lastAsked_ = {};  // the next chunk, at once
    if (!assembly_->whole()) return;
    const auto blob = std::exchange(assembly_, {})->checked();
    const auto part = blob ? wire::readSchoolPart(*blob) : std::nullopt;
    if (!part || part->stream != stream_) return;
    keep(*part);
    load(*part);
}

void SchoolFollower::turn(net::Moment now) {
    if (!isMissing_ || motion_ == nullptr || now - lastAsked_ < kBetweenRequests) return;
    lastAsked_ = now;
    if (assembly_) return say_(wire::chunkRequest(assembly_->digest(), assembly_->nextOffset()));
    v1::Envelope message;
    message.mutable_keyframe_request();
    say_(std::move(message));
}

// A frame of a look that has no motion comes without fish: it is not built yet, or shows patterns
// alone. A frame whose fish are not known any more is left out.
std::optional<ArrivedState> SchoolFollower::next() {
    while ((follows_ || motion_ == nullptr) && !waiting_.empty()) {
        Waiting& first = waiting_.front();
        if (motion_ == nullptr) {
            ArrivedState bare{std::move(first.frame), first.arrival};
            waiting_.pop_front();
            return bare;
        }
        if (!advanceTo(first.frame.tick)) {
            lose();
            return std::nullopt;
        }
        ArrivedState ready{std::move(first.frame), first.arrival};
        waiting_.pop_front();
        const auto* const after = recent_.at(ready.state.tick);
        const bool isBetween = ready.state.fraction < 1.0F;
        const auto* const before = isBetween ? recent_.at({ready.state.tick.value - 1}) : after;
        if (after == nullptr || before == nullptr) continue;
        ready.state.after = *after;
        ready.state.areOfTick = true;
        if (isBetween) ready.state.before = *before;
        goOn();
        return ready;
    }
    return std::nullopt;
}

bool SchoolFollower::advanceTo(Tick tick) {
    while (follows_->school.tick < tick) {
        const auto step = steps_.find({follows_->school.tick.value + 1});
        if (step == steps_.end()) return false;
        if (!advance(step->second)) {
            follows_.reset();
            return false;
        }
    }
    return true;
}

// The commands of the step, the motor, and who was placed.
bool SchoolFollower::advance(const wire::SchoolStep& step) {
    school::SchoolState& school = follows_->school;
    const auto placed = school::decodeStep(step.tick, step.code, school.commands, follows_->memory);
    if (!placed) return false;
    motion_->advance(school);
    for (const school::PlacedFish& one : *placed) school.set(one.fish, one.record);
    recent_.remember(school);
    if (step.hash) check(*step.hash);
    return true;
}

// It goes on with what it has until the keyframe has come.
void SchoolFollower::check(std::uint64_t hash) {
    if (school::hashOf(recent_.newest(), follows_->school.commands) == hash) return;
    ++mismatches_;
    isWrong_ = true;
    lose();
}

// It follows: what was lost has come again. Steps of ticks that have passed are forgotten; a
// keyframe that heals what is wrong needs them.
void SchoolFollower::goOn() {
    if (isWrong_) return;
    isMissing_ = false;
    assembly_.reset();
    steps_.erase(steps_.begin(), steps_.upper_bound(follows_->school.tick));
}

}  // namespace aquarama::session
