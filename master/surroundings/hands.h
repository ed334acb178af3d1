// SPDX-License-Identifier: Apache-2.0
// Hands before the wall as fish perceive them: where each is in the world, and whether it is quick
// or holds still.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "common/base/units.h"
#include "common/base/wall_hands.h"
#include "master/surroundings/vessel.h"

namespace aquarama::surroundings {

// A hand in the world, metres. Between the viewer and what lies behind the hand all fish see it.
struct HeldHand {
    WallHand seen;
    Tick heard;
    float quick = 0;  // 0 slow to 1 quick
    float still = 0;  // 0 just moved to 1 held still for a while
    // Set by placeHands(): the viewer's eye, the unit vector to the hand, and where fish that come
    // to it gather.
    glm::vec3 eye{}, direction{}, place{};
};

// All of them, in the order in which they came. Owned by the world.
struct HeldHands {
    std::vector<HeldHand> hands;
    Tick heard;
};

// Room for as many as there can be.
[[nodiscard]] HeldHands makeHands();
// What a tracker sees after this tick; who is not among them is gone.
void holdHands(HeldHands& held, const WallHands& seen, Tick tick);
// Forgets all where nothing was heard for kTicksOfAHand, and places the others before the
// submarine.
void placeHands(HeldHands& held, const Vessel& vessel, Tick tick);
// The hash with them folded in; the same where there are none.
[[nodiscard]] std::uint64_t foldedHands(std::uint64_t hash, const HeldHands& held);

}  // namespace aquarama::surroundings
