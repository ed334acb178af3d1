// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/hands.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "common/base/digest.h"
#include "common/place/place.h"

namespace aquarama::surroundings {

namespace {

// Metres a second on the screen: from here on a hand is not still, is a little quick, is quick.
constexpr float kMoves = 0.25F;
constexpr float kBrisk = 0.5F;
constexpr float kQuick = 1.2F;
// A hand counts as quick for so long after, and as still after so long.
constexpr float kCalmsSeconds = 1.0F;
constexpr float kStillSeconds = 1.0F;
// Where fish meet a hand, from the viewer: outside of what the submarine keeps clear.
constexpr float kMeetsMetres = 2.4F;

// The hand as it was, seen again.
void see(HeldHand& hand, const WallHand& now, Tick tick) {
    const auto ticks =
        static_cast<float>(std::max<std::uint64_t>(1, tick.value - hand.heard.value));
    const float seconds = ticks * kTickSeconds;
    const float speed = place::lengthOf(now.point - hand.seen.point) / seconds;
    const float brisk = std::clamp((speed - kBrisk) / (kQuick - kBrisk), 0.0F, 1.0F);
    hand.quick = std::max(brisk, hand.quick - seconds / kCalmsSeconds);
    hand.still = speed > kMoves ? 0.0F : std::min(1.0F, hand.still + seconds / kStillSeconds);
    hand.seen = now;
    hand.heard = tick;
}

// By a unit quaternion.
glm::vec3 turned(const motion::Quaternion& q, glm::vec3 v) {
    const glm::vec3 axis{q.x, q.y, q.z};
    const glm::vec3 once = glm::cross(axis, v) + v * q.w;
    return v + glm::cross(axis, once) * 2.0F;
}

}  // namespace

HeldHands makeHands() {
    HeldHands held;
    held.hands.reserve(kMostWallHands);
    return held;
}

void holdHands(HeldHands& held, const WallHands& seen, Tick tick) {
    held.heard = tick;
    std::erase_if(held.hands, [&](const HeldHand& hand) {
        return std::ranges::find(seen, hand.seen.id, &WallHand::id) == seen.end();
    });
    for (const WallHand& now : seen) {
        const auto known = std::ranges::find(
            held.hands, now.id, [](const HeldHand& hand) { return hand.seen.id; });
        if (known != held.hands.end())
            see(*known, now, tick);
        else if (held.hands.size() < kMostWallHands)
            held.hands.push_back({.seen = now, .heard = tick});
    }
}

void placeHands(HeldHands& held, const Vessel& vessel, Tick tick) {
    if (held.hands.empty()) return;
    if (tick.value - held.heard.value > kTicksOfAHand) return held.hands.clear();
    const motion::Quaternion turn = worldFromBody(vessel.attitude);
    for (HeldHand& hand : held.hands) {
        hand.eye = vessel.position;
        hand.direction = place::directionOf(turned(turn, hand.seen.point), {0, 0, -1});
        hand.place = hand.eye + hand.direction * kMeetsMetres;
    }
}

std::uint64_t foldedHands(std::uint64_t hash, const HeldHands& held) {
    for (const HeldHand& hand : held.hands) {
        hash = foldedOne(foldedOne(hash, hand.seen.id), hand.heard.value);
        for (const int axis : {0, 1, 2}) hash = foldedOne(hash, hand.seen.point[axis]);
        hash = foldedOne(foldedOne(hash, hand.quick), hand.still);
    }
    return hash;
}

}  // namespace aquarama::surroundings
