// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/input_arbitration.h"

#include <chrono>

#include "master/conductor/snapshot_buffer.h"

namespace aquarama::conductor {

namespace {

constexpr net::Instant kSilence = kTicksOfAHand * kTickPeriod;
// A window says thirty times a second what its hands do; who says much more is not heard.
constexpr net::Instant kBetween = std::chrono::milliseconds(8);
constexpr std::size_t kMostPilots = 256;

}  // namespace

bool InputArbitration::holds(const HeldInput& input, net::Instant now) {
    return input.holds && now - input.heard < kSilence;
}

void InputArbitration::forgetTheSilent(net::Instant now) {
    std::erase_if(inputs_, [&](const auto& one) { return now - one.second.heard >= kSilence; });
}

bool InputArbitration::accepts(const net::PeerId& pilot,
                               const Steering& steering,
                               net::Instant now) {
    forgetTheSilent(now);
    const bool holdsNow = steering != Steering{};
    const auto known = inputs_.find(pilot);
    if (known == inputs_.end() && (!holdsNow || inputs_.size() >= kMostPilots)) return false;
    HeldInput& input = inputs_[pilot];
    const bool held = input.holds;
    if (held && holdsNow && now - input.heard < kBetween) return false;
    input = {holdsNow, now};
    const auto holder = inputs_.find(holder_);
    const bool isFree = holder == inputs_.end() || !holder->second.holds;
    if (holdsNow && (!held || isFree)) holder_ = pilot;
    return holder_ == pilot && (holdsNow || held);
}

std::optional<net::PeerId> InputArbitration::pilot(net::Instant now) const {
    const auto holder = inputs_.find(holder_);
    if (holder == inputs_.end() || !holds(holder->second, now)) return std::nullopt;
    return holder_;
}

}  // namespace aquarama::conductor
