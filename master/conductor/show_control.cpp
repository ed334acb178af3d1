// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/show_control.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <utility>

namespace aquarama::conductor {
namespace {

constexpr std::chrono::duration<float> kFade{0.5F};

// The values that hold at once, whatever look is shown.
v1::WantedShow ofAnyLook(const v1::WantedShow& show) {
    v1::WantedShow values = show;
    values.clear_version();
    values.clear_scene();
    values.clear_quality();
    values.clear_pattern();
    values.clear_colour_returned();
    return values;
}

// The others.
v1::WantedShow ofLook(const v1::WantedShow& show) {
    v1::WantedShow values;
    if (show.has_scene()) values.set_scene(show.scene());
    if (show.has_quality()) values.set_quality(show.quality());
    if (show.has_pattern()) values.set_pattern(show.pattern());
    if (show.has_colour_returned()) values.set_colour_returned(show.colour_returned());
    return values;
}

// With every value.
v1::WantedShow completed(const v1::WantedShow& show) {
    v1::WantedShow all;
    all.set_quality(v1::WantedShow::AUTO);
    all.set_pattern(v1::WantedShow::WORLD);
    all.set_black(false);
    all.set_freeze(false);
    all.set_guests(true);
    all.set_drawings(true);
    all.set_brightness(1);
    all.set_day(v1::WantedShow::CLOCK);
    all.MergeFrom(show);
    return all;
}

// Also where there is none: the scene's own.
void takeColour(v1::WantedShow& show, const v1::WantedShow& from) {
    show.clear_colour_returned();
    if (from.has_colour_returned()) show.set_colour_returned(from.colour_returned());
}

bool isWorld(const v1::WantedShow& show) {
    return show.pattern() == v1::WantedShow::WORLD;
}

}  // namespace

void SignHold::hold(const v1::HeldSign& sign, net::Moment now) {
    held_ = sign;
    heard_ = now;
}

void SignHold::expire(net::Moment now) {
    if (held_.has_sign() && now - heard_ > kPatience) held_.clear_sign();
}

bool ScanHold::hold(std::uint64_t holder,
                    const config::ScanPattern& pattern,
                    Frame next,
                    net::Moment now) {
    if (pattern_ && holder != holder_) return false;
    holder_ = holder;
    heard_ = now;
    if (pattern_ == pattern) return true;
    pattern_ = pattern;
    first_ = next;
    ++changes_;
    return true;
}

void ScanHold::end(std::uint64_t holder) {
    if (!pattern_ || holder != holder_) return;
    pattern_.reset();
    ++changes_;
}

bool ScanHold::expires(net::Moment now) {
    if (!pattern_ || now - heard_ <= kPatience) return false;
    end(holder_);
    return true;
}

ShowControl::ShowControl(v1::WantedShow wanted, v1::WantedShow kept, ask::OrderBook& book)
    : book_{book},
      wanted_{completed(wanted)},
      kept_{std::move(kept)},
      hasWorld_{isWorld(wanted_)},
      brightness_{wanted_.black() ? 0.0F : static_cast<float>(wanted_.brightness())} {}

Answer ShowControl::set(std::uint64_t request, const v1::WantedShow& change) {
    if (const Answer* known = book_.find(request)) return *known;
    v1::WantedShow goal = wanted_;
    wire::apply(goal, change);
    const bool lacksWorld = isWorld(goal) && !hasWorld_;
    const bool isAnotherLook =
        goal.scene() != wanted_.scene() || goal.quality() != wanted_.quality() || lacksWorld;
    if (isAnotherLook && phase_ != Phase::Steady)
        return book_.enter(request,
                           {Outcome::Refused,
                            "another change is under way (" + waitingFor_ + "); wait for its end"});
    if (!wire::areSame(goal, wanted_)) ++version_;
    // At once, whatever else is under way.
    for (v1::WantedShow* show : {&wanted_, &next_, &kept_}) show->MergeFrom(ofAnyLook(change));
    if (isAnotherLook) return begin(request, goal, change);
    wanted_.set_pattern(goal.pattern());
    next_.set_pattern(goal.pattern());
    takeColour(wanted_, goal);
    if (next_.scene() == wanted_.scene()) takeColour(next_, goal);
    wire::apply(kept_, ofLook(change));
    return book_.enter(request, {});
}

Answer ShowControl::begin(std::uint64_t request,
                          const v1::WantedShow& goal,
                          const v1::WantedShow& change) {
    next_ = goal;
    change_ = ofLook(change);
    underWay_ = request;
    ++nextLook_;
    nextHasWorld_ = hasWorld_ || isWorld(goal);
    phase_ = goal.scene() != wanted_.scene() ? Phase::Making : Phase::Preparing;
    setWaitingFor(phase_ == Phase::Making ? "the world of scene " + goal.scene() + " is being made"
                                          : "nodes build it");
    return {Outcome::Waiting, waitingFor_};
}

bool ShowControl::renew() {
    if (phase_ != Phase::Steady) return false;
    next_ = wanted_;
    change_.Clear();
    underWay_ = 0;
    ++nextLook_;
    nextHasWorld_ = hasWorld_;
    phase_ = Phase::Preparing;
    waitingFor_ = "nodes build the wall's new files";
    return true;
}

void ShowControl::made() {
    assert(phase_ == Phase::Making);
    phase_ = Phase::Preparing;
}

void ShowControl::prepared() {
    assert(phase_ == Phase::Preparing);
    phase_ = next_.scene() != wanted_.scene() ? Phase::Fading : Phase::Switching;
}

void ShowControl::blackShown() {
    if (phase_ == Phase::Fading) phase_ = Phase::Switching;
}

void ShowControl::switched() {
    assert(phase_ == Phase::Switching);
    hasWorld_ = nextHasWorld_;
    wanted_ = next_;
    wire::apply(kept_, change_);
    phase_ = Phase::Steady;
    look_ = nextLook_;
    ++version_;
    brightnessAt_ = {};
    settle({});
}

void ShowControl::fail(const std::string& reason) {
    assert(phase_ != Phase::Steady);
    phase_ = Phase::Steady;
    settle({Outcome::Refused, reason});
}

void ShowControl::setWaitingFor(const std::string& what) {
    waitingFor_ = what;
    if (underWay_ != 0) book_.enter(underWay_, {Outcome::Waiting, what});
}

void ShowControl::settle(const Answer& answer) {
    waitingFor_.clear();
    if (const std::uint64_t request = std::exchange(underWay_, 0)) book_.enter(request, answer);
}

float ShowControl::brightness(net::Moment now) {
    const std::chrono::duration<float> passed =
        brightnessAt_ == net::Moment{} ? net::Duration{} : now - brightnessAt_;
    brightnessAt_ = now;
    const bool isDark = wanted_.black() || phase_ == Phase::Fading || phase_ == Phase::Switching;
    const float goal = isDark ? 0.0F : static_cast<float>(wanted_.brightness());
    const float step = passed / kFade;
    brightness_ = std::clamp(goal, brightness_ - step, brightness_ + step);
    return brightness_;
}

}  // namespace aquarama::conductor
