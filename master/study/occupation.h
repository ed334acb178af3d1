// SPDX-License-Identifier: Apache-2.0
// What a fish is busy with, as budgets of time count it: its intention, divided further where
// published budgets are.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "master/fish/fish_view.h"
#include "master/fish/minds.h"

namespace aquarama::study {

// The first kIntentions are the intentions, by their numbers.
enum class Occupation : std::uint8_t {
    // A cleaner with a client.
    Inspect = fish::kIntentions,
    // Rides beside a fish that its species shadows.
    Shadow,
    // A predator from ambush that stands or hangs at its post.
    LieInWait,
    // A predator at ease that swims.
    Patrol,
};
inline constexpr std::size_t kOccupations = fish::kIntentions + 4;
// The words for it in tables: of an intention its name.
[[nodiscard]] const char* nameOf(Occupation occupation);

// A fish of which these are the view, the minds and the species.
struct StudiedFish {
    const fish::FishView& view;
    const fish::Minds& minds;
    std::span<const fish::SpeciesParameters> species;
};

// A fish counts as what it would do if no fish or obstacle were in its way. One that is away must
// not be asked.
[[nodiscard]] Occupation occupationOf(const StudiedFish& of, std::uint32_t fish);

// Whether the fish rides beside one that its species shadows: within kBesideMetres, both swimming
// the same way within 30 degrees. O(fish of the shadowed species).
[[nodiscard]] bool ridesBesideAnother(const StudiedFish& of, std::uint32_t fish);
inline constexpr float kBesideMetres = 0.5F;

// Whether it is a cleaner, and within a length of its client.
[[nodiscard]] bool inspects(const StudiedFish& of, std::uint32_t fish);

// Whether it hides or rests in a shelter, or goes there: among branches, in a hole, under a ledge.
[[nodiscard]] bool isSheltered(const StudiedFish& of, std::uint32_t fish);

}  // namespace aquarama::study
