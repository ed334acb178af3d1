// SPDX-License-Identifier: Apache-2.0
#include "console/cues/touch_listener.h"

#include <algorithm>
#include <utility>

#include "common/base/hash.h"

namespace aquarama::console {

namespace {

// Of one tick, of a tracker that speaks a hundred times a second; more are lost.
constexpr int kMostPackets = 64;

// Of a hand and its tracker; the same as long as it is there.
std::uint32_t idOf(const tuio::Hand& hand) {
    std::uint32_t id = static_cast<std::uint32_t>(hand.session);
    for (const char character : hand.source)
        id = hashOf(id, static_cast<std::uint32_t>(static_cast<unsigned char>(character)));
    return id;
}

}  // namespace

glm::vec3 pointAt(const config::TouchedSurface& surface,
                  const glm::dvec3& sweetSpot,
                  glm::vec2 place) {
    const glm::dvec3 across = surface.topRight - surface.topLeft;
    const glm::dvec3 down = surface.bottomLeft - surface.topLeft;
    return glm::vec3(surface.topLeft + across * static_cast<double>(place.x) +
                     down * static_cast<double>(place.y) - sweetSpot);
}

TouchListener::TouchListener(config::TouchedSurface surface, const glm::dvec3& sweetSpot)
    : surface_{std::move(surface)}, sweetSpot_{sweetSpot}, port_{surface_.listen} {}

std::optional<WallHands> TouchListener::tick(double now) {
    hear(now);
    WallHands hands;
    for (const tuio::Hand& hand : seen_.seen(now))
        if (hands.size() < kMostWallHands)
            hands.push_back({idOf(hand), pointAt(surface_, sweetSpot_, hand.place)});
    const bool isNews = !hands.empty() || hadHands_;
    hadHands_ = !hands.empty();
    return isNews ? std::optional(std::move(hands)) : std::nullopt;
}

// What is malformed, or of somebody else, is dropped.
void TouchListener::hear(double now) {
    for (int i = 0; i < kMostPackets; ++i) {
        const auto datagram = port_.receive(osc::kMostPacketBytes + 1);
        if (!datagram) return;
        if (std::ranges::find(surface_.from, datagram->from.host) == surface_.from.end()) continue;
        seen_.hear(osc::decode(datagram->bytes).messages, now);
    }
}

}  // namespace aquarama::console
