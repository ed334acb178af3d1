// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/helm.h"

#include <chrono>

#include "master/conductor/timeline.h"

namespace aquarama::conductor {

namespace {

constexpr net::Instant kSilence = kTicksOfAHand * kTickPeriod;
// A window says thirty times a second what its hands do; who says much more is not heard.
constexpr net::Instant kBetween = std::chrono::milliseconds(8);
constexpr std::size_t kMostHands = 256;

}  // namespace

bool Helm::holds(const Hand& hand, net::Instant now) {
    return hand.holds && now - hand.heard < kSilence;
}

void Helm::forgetTheSilent(net::Instant now) {
    std::erase_if(hands_, [&](const auto& one) { return now - one.second.heard >= kSilence; });
}

bool Helm::heeds(const net::PeerId& pilot, const Steering& steering, net::Instant now) {
    forgetTheSilent(now);
    const bool holdsNow = steering != Steering{};
    const auto known = hands_.find(pilot);
    if (known == hands_.end() && (!holdsNow || hands_.size() >= kMostHands)) return false;
    Hand& hand = hands_[pilot];
    const bool held = hand.holds;
    if (held && holdsNow && now - hand.heard < kBetween) return false;
    hand = {holdsNow, now};
    const auto holder = hands_.find(holder_);
    const bool isFree = holder == hands_.end() || !holder->second.holds;
    if (holdsNow && (!held || isFree)) holder_ = pilot;
    return holder_ == pilot && (holdsNow || held);
}

std::optional<net::PeerId> Helm::pilot(net::Instant now) const {
    const auto holder = hands_.find(holder_);
    if (holder == hands_.end() || !holds(holder->second, now)) return std::nullopt;
    return holder_;
}

}  // namespace aquarama::conductor
