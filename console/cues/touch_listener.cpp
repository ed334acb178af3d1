// SPDX-License-Identifier: Apache-2.0
#include "console/cues/touch_listener.h"

#include <utility>

#include <glm/common.hpp>

#include "common/base/hash.h"

namespace aquarama::console {

namespace {

// What a person's place takes of a new one in each tick: feet step, and scanners see now one leg,
// now the other. 0.35 s behind.
constexpr double kShareOfNew = 0.25;

// Of a hand and its tracker; the same as long as it is there.
std::uint32_t idOf(const tuio::Hand& hand) {
    std::uint32_t id = static_cast<std::uint32_t>(hand.session);
    for (const char character : hand.source)
        id = hashOf(id, static_cast<std::uint32_t>(static_cast<unsigned char>(character)));
    return id;
}

}  // namespace

TouchListener::TouchListener(const config::Rig& rig)
    : places_{rig}, port_{rig.touch->listen, rig.touch->from} {}

std::optional<WallHands> TouchListener::tick(double now) {
    WallHands hands;
    std::map<std::uint32_t, glm::dvec2> seen;
    for (const tuio::Hand& hand : port_.hear(now)) {
        const std::uint32_t id = idOf(hand);
        const glm::dvec2 place = seen[id] = steadied(id, hand.place);
        const auto point = places_.pointOf(place);
        if (point && hands.size() < kMostWallHands) hands.push_back({id, *point});
    }
    known_ = std::move(seen);
    const bool isNews = !hands.empty() || hadHands_;
    hadHands_ = !hands.empty();
    return isNews ? std::optional(std::move(hands)) : std::nullopt;
}

// A hand is where it is seen.
glm::dvec2 TouchListener::steadied(std::uint32_t id, glm::dvec2 place) const {
    const auto known = known_.find(id);
    if (!places_.arePeople() || known == known_.end()) return place;
    return glm::mix(known->second, place, kShareOfNew);
}

}  // namespace aquarama::console
