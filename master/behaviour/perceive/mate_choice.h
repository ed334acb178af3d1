// SPDX-License-Identifier: Apache-2.0
// Whom a fish takes for a mate (Tu 1996, section 5.6.6): one of its species and the other sex that
// is willing and about as long; of those a male prefers the nearer, a female the larger.
#pragma once

#include <cstdint>

#include "master/fish/fish_view.h"
#include "master/fish/minds.h"

namespace aquarama::behaviour {

// The shorter of a pair is at least this share of the longer.
inline constexpr float kLeastSizeRatio = 0.7F;
// Libido below this, as after spawning, no mate in sight can raise.
inline constexpr float kTemptedFrom = 0.1F;

// `likes` are those of the fish that looks.
[[nodiscard]] bool suitsAsMate(const fish::FishView& view,
                               std::uint8_t likes,
                               std::uint32_t fish,
                               std::uint32_t other);

// So many times its distance it counts as far, 1 or more: one that courts another as farther, and
// so does everybody to one whose courtship is answered; to a female a smaller one as farther.
[[nodiscard]] float dearnessOfMate(const fish::FishView& view,
                                   std::uint8_t likes,
                                   std::uint32_t fish,
                                   std::uint32_t other);

}  // namespace aquarama::behaviour
