// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/show_control.h"

#include <algorithm>
#include <cassert>
#include <chrono>

namespace aquarama::conductor {
namespace {

constexpr std::chrono::duration<float> kFade{0.5F};
constexpr std::size_t kAnswers = 16;

template <class Value>
void put(std::optional<Value>& into, const std::optional<Value>& value) {
    if (value) into = value;
}

}  // namespace

bool ScanHold::hold(std::uint64_t holder,
                    const config::ScanPattern& pattern,
                    Frame next,
                    net::Instant now) {
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

bool ScanHold::expires(net::Instant now) {
    if (!pattern_ || now - heard_ <= kPatience) return false;
    end(holder_);
    return true;
}

ShowControl::ShowControl(WantedShow wanted, ShowChange kept)
    : wanted_{std::move(wanted)},
      kept_{std::move(kept)},
      hasWorld_{wanted_.pattern == wire::Pattern::World},
      brightness_{wanted_.black ? 0.0F : 1.0F} {}

Answer ShowControl::set(std::uint64_t request, const ShowChange& change) {
    const auto known = std::ranges::find(answers_, request, &RequestAndAnswer::first);
    if (known != answers_.end()) {
        if (known->second.outcome == Outcome::Waiting) known->second.reason = waitingFor_;
        return known->second;
    }
    const WantedShow goal = with(wanted_, change);
    const bool lacksWorld = goal.pattern == wire::Pattern::World && !hasWorld_;
    const bool isAnotherLook =
        goal.scene != wanted_.scene || goal.quality != wanted_.quality || lacksWorld;
    if (isAnotherLook && phase_ != Phase::Steady)
        return remember(request,
                        {Outcome::Refused,
                         "another change is under way (" + waitingFor_ + "); wait for its end"});
    if (goal != wanted_) ++version_;
    // At once, whatever else is under way.
    wanted_.black = next_.black = goal.black;
    wanted_.freeze = next_.freeze = goal.freeze;
    put(kept_.black, change.black);
    put(kept_.freeze, change.freeze);
    if (isAnotherLook) return begin(request, goal, change);
    wanted_.pattern = next_.pattern = goal.pattern;
    put(kept_.pattern, change.pattern);
    put(kept_.quality, change.quality);
    put(kept_.scene, change.scene);
    return remember(request, {});
}

Answer ShowControl::begin(std::uint64_t request, const WantedShow& goal, const ShowChange& change) {
    next_ = goal;
    change_ = change;
    underWay_ = request;
    ++nextLook_;
    nextHasWorld_ = hasWorld_ || goal.pattern == wire::Pattern::World;
    phase_ = goal.scene != wanted_.scene ? Phase::Making : Phase::Preparing;
    waitingFor_ = phase_ == Phase::Making ? "the world of scene " + goal.scene + " is being made"
                                          : "nodes build it";
    return remember(request, {Outcome::Waiting, waitingFor_});
}

bool ShowControl::renew() {
    if (phase_ != Phase::Steady) return false;
    next_ = wanted_;
    change_ = {};
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
    phase_ = next_.scene != wanted_.scene ? Phase::Fading : Phase::Switching;
}

void ShowControl::blackShown() {
    if (phase_ == Phase::Fading) phase_ = Phase::Switching;
}

void ShowControl::switched() {
    assert(phase_ == Phase::Switching);
    hasWorld_ = nextHasWorld_;
    wanted_ = next_;
    put(kept_.scene, change_.scene);
    put(kept_.quality, change_.quality);
    put(kept_.pattern, change_.pattern);
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

Answer ShowControl::remember(std::uint64_t request, const Answer& answer) {
    answers_.emplace_back(request, answer);
    if (answers_.size() > kAnswers) answers_.pop_front();
    return answer;
}

void ShowControl::settle(const Answer& answer) {
    waitingFor_.clear();
    if (underWay_ == 0) return;
    const auto known = std::ranges::find(answers_, underWay_, &RequestAndAnswer::first);
    if (known != answers_.end())
        known->second = answer;
    else  // many others have asked meanwhile
        remember(underWay_, answer);
}

float ShowControl::brightness(net::Instant now) {
    const std::chrono::duration<float> passed =
        brightnessAt_ == net::Instant{} ? net::Instant{} : now - brightnessAt_;
    brightnessAt_ = now;
    const bool isDark = wanted_.black || phase_ == Phase::Fading || phase_ == Phase::Switching;
    const float step = passed / kFade;
    brightness_ = std::clamp(isDark ? brightness_ - step : brightness_ + step, 0.0F, 1.0F);
    return brightness_;
}

}  // namespace aquarama::conductor
