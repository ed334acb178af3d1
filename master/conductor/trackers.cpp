// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/trackers.h"

#include <chrono>

#include "master/conductor/simulation_thread.h"

namespace aquarama::conductor {

namespace {

constexpr net::Duration kTrackerSilence = kTicksOfAHand * kTickPeriod;
// Trackers report up to a hundred times a second; the world hears thirty.
constexpr net::Duration kBetweenHands = std::chrono::milliseconds(30);
constexpr std::size_t kMostTrackers = 64;
// Ids of one tracker's hands are below this.
constexpr std::uint32_t kIdsOfATracker = 1U << 16U;

}  // namespace

bool Trackers::hear(const net::PeerId& tracker, const WallHands& hands, net::Moment now) {
    std::erase_if(heard_, [&](const auto& one) { return now - one.second.at >= kTrackerSilence; });
    const auto known = heard_.find(tracker);
    if (known == heard_.end()) {
        if (hands.empty() || heard_.size() >= kMostTrackers) return false;
        heard_[tracker] = {++numbers_, hands, now};
        return true;
    }
    // That the last one has left is heard at once.
    if (!hands.empty() && now - known->second.at < kBetweenHands) return false;
    known->second.hands = hands;
    known->second.at = now;
    return true;
}

WallHands Trackers::all(net::Moment now) const {
    WallHands all;
    for (const auto& [peer, heard] : heard_) {
        if (now - heard.at >= kTrackerSilence) continue;
        for (const WallHand& hand : heard.hands)
            if (all.size() < kMostWallHands)
                all.push_back(
                    {heard.number * kIdsOfATracker + hand.id % kIdsOfATracker, hand.point});
    }
    return all;
}

}  // namespace aquarama::conductor
