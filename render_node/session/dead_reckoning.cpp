// SPDX-License-Identifier: Apache-2.0
#include "render_node/session/dead_reckoning.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cmath>
#include <utility>

namespace aquarama::session {
namespace {

// What the world lags behind is made up for at this share of its pace.
constexpr double kCatchUp = 0.25;
// A frame is made so many periods before it is to be shown.
constexpr double kAhead = 2.5;
// So long fish go on by their last commands.
constexpr std::uint64_t kTicksAsCommanded = 120;
constexpr std::uint64_t kTicksACommand = 8;
// After a machine has slept, fish go on where they were.
constexpr std::uint64_t kMostTicks = 600;

}  // namespace

void DeadReckoning::saw(const wire::StateFrame& frame) {
    if (newest_ && frame.frame < newest_->frame) return;
    newest_ = wire::StateFrame{{frame}, {}, {}};
}

void DeadReckoning::released(Frame frame, net::Moment at) {
    released_ = {frame, at};
}

void DeadReckoning::begin(Cause cause,
                          const SchoolFollower& school,
                          std::shared_ptr<school::SchoolMotion> motion) {
    const school::SchoolState* const newest = school.newest();
    if (!newest_ || !released_ || newest == nullptr || motion == nullptr) return;
    const auto [missed, lag] =
        cause == Cause::Silence ? std::pair{kSilent, kSilent} : std::pair{1, 0};
    fish_ = Swimming{*newest,
                     school.recent(),
                     std::move(motion),
                     {newest->tick.value + kTicksAsCommanded},
                     {released_->frame.value + static_cast<std::uint64_t>(missed)},
                     missed,
                     lag};
}

Frame DeadReckoning::firstFrame() const {
    return {released_->frame.value + static_cast<std::uint64_t>(fish_->missed) + 1};
}

void DeadReckoning::forget() {
    end();
    newest_.reset();
    released_.reset();
}

bool DeadReckoning::isSilent(net::Moment heard, net::Moment now) const {
    return net::secondsIn(now - heard) > kSilent * periodSeconds_;
}

net::Moment DeadReckoning::momentOf(Frame frame) const {
    const auto periods = static_cast<double>(frame.value - released_->frame.value);
    return released_->at + std::chrono::round<net::Duration>(
                               std::chrono::duration<double>(periods * periodSeconds_));
}

double DeadReckoning::worldAt(Frame frame) const {
    const double tickOfNewest =
        static_cast<double>(newest_->tick.value) - 1 + static_cast<double>(newest_->fraction);
    const double ticksAFrame = newest_->show.frozen ? 0 : kTicksPerSecond * periodSeconds_;
    const auto since = [&](Frame one) {
        return static_cast<double>(one.value) - static_cast<double>(released_->frame.value);
    };
    const double lag = fish_->lag - kCatchUp * (since(frame) - fish_->missed);
    const double frames = since(frame) - std::max(lag, 0.0) - since(newest_->frame);
    return std::max(tickOfNewest + frames * ticksAFrame, 0.0);
}

std::optional<ArrivedState> DeadReckoning::due(net::Moment now) {
    if (!isOn()) return std::nullopt;
    const double periods = net::secondsIn(now - released_->at) / periodSeconds_ + kAhead;
    const Frame newest{released_->frame.value +
                       static_cast<std::uint64_t>(std::max(std::floor(periods), 0.0))};
    if (newest <= fish_->last) return std::nullopt;
    return make(newest);
}

ArrivedState DeadReckoning::next() {
    return make({fish_->last.value + 1});
}

ArrivedState DeadReckoning::make(Frame frame) {
    assert(isOn());
    fish_->last = frame;
    const double world = worldAt(frame);
    const Tick tick{static_cast<std::uint64_t>(std::ceil(world))};
    swimTo(tick);
    ArrivedState made{*newest_, net::monotonicNow(), true};
    wire::StateFrame& state = made.state;
    state.frame = frame;
    state.areOfTick = false;
    state.tick = std::max(tick, fish_->recent.oldestTick());
    state.after = *fish_->recent.at(state.tick);
    const auto* const before =
        state.tick.value > 0 ? fish_->recent.at({state.tick.value - 1}) : nullptr;
    state.fraction = before == nullptr
                         ? 1.0F
                         : static_cast<float>(world - (static_cast<double>(state.tick.value) - 1));
    if (state.fraction < 1.0F) {
        state.before = *before;
        state.foodBefore = state.foodAfter;
    } else {
        state.foodBefore.clear();
    }
    return made;
}

void DeadReckoning::swimTo(Tick tick) {
    school::SchoolState& school = fish_->school;
    if (tick.value > school.tick.value + kMostTicks) school.tick.value = tick.value - 1;
    using Alone = school::SchoolMotion::Alone;
    while (school.tick < tick) {
        if (school.tick.value % kTicksACommand == 0)
            fish_->motion->command(school,
                                   school.tick < fish_->circles ? Alone::Onward : Alone::InCircles);
        fish_->motion->advance(school);
        fish_->recent.remember(school);
    }
}

std::optional<ReleaseOrder> DeadReckoning::release(Frame finished) const {
    const bool isNext = isOn() && finished > released_->frame;
    return isNext ? std::optional(ReleaseOrder{finished, momentOf(finished)}) : std::nullopt;
}

ReleaseOrder DeadReckoning::overtaken(net::Moment now) const {
    const Frame last{firstFrame().value - 1};
    return {last, std::max(now, momentOf(last))};
}

}  // namespace aquarama::session
