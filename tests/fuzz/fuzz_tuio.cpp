// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <span>

#include "common/tuio/hand_set.h"
#include "tests/fuzz/promise.h"
#include "tests/fuzz/targets.h"

namespace aquarama {

namespace {

bool isOfASurface(const tuio::Hand& hand) {
    const auto isShare = [](float value) { return value >= 0 && value <= 1; };
    const auto isSpeed = [](float value) { return std::abs(value) <= 100; };
    return isShare(hand.place.x) && isShare(hand.place.y) && isSpeed(hand.velocity.x) &&
           isSpeed(hand.velocity.y);
}

}  // namespace

// Twice, as what is kept of a first packet meets the second.
int fuzzTuio(const std::uint8_t* bytes, std::size_t size) {
    const osc::OscPacket packet = osc::decode(std::as_bytes(std::span(bytes, size)));
    tuio::HandSet surface;
    for (const double now : {0.0, 0.5}) {
        surface.hear(packet.messages, now);
        const auto hands = surface.seen(now);
        promise(hands.size() <= tuio::kMostHands, "hands are few");
        for (const tuio::Hand& hand : hands)
            promise(isOfASurface(hand), "a hand is on the surface");
    }
    return 0;
}

}  // namespace aquarama
