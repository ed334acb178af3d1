// SPDX-License-Identifier: Apache-2.0
// The destinations of a fish at ease: around its home, along its beat, or in all its water.
#pragma once

#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

#include "common/base/units.h"
#include "common/config/species.h"
#include "common/place/place.h"
#include "master/behaviour/perceive.h"
#include "master/fish/fish_view.h"
#include "master/surroundings/obstacles.h"

namespace aquarama::behaviour {

// A point in the water for a fish to swim to, near the depth that its species likes best. Another
// one every 15 s.
[[nodiscard]] glm::vec3 wanderingGoal(std::uint32_t seed,
                                      const place::Region& water,
                                      float bestDepthMetres,
                                      std::size_t fish,
                                      Tick tick);

// The home of a household (a number shared by fish that live together), drawn by the seed: over a
// rock where the species lives on the reef and there is one, else anywhere.
[[nodiscard]] glm::vec3 homeOf(std::uint32_t seed,
                               const config::Home& home,
                               const surroundings::Obstacles& obstacles,
                               float bestDepthMetres,
                               std::uint32_t household);
// Household of a fish: two by two the fish of a species live together.
[[nodiscard]] std::uint32_t householdOf(std::uint32_t firstOfKind, std::uint32_t fish);

// The next point of a predator's beat: an oval near the borders of the water; from time to time
// through the middle of a bait ball.
[[nodiscard]] glm::vec3 beatGoal(const Environment& environment,
                                 const fish::SpeciesParameters& parameters,
                                 std::uint32_t fish,
                                 glm::vec3 position);

// The destination of a fish at ease.
struct Bound {
    // Offset from the fish to the point, metres.
    glm::vec3 towards{};
    // 0 within the range of its home, 1 at its greatest distance (leash) and beyond.
    float strayed = 0;
};
// Chooses the destination by the home or role of the species; a predator without a home patrols its
// beat.
[[nodiscard]] Bound boundFor(const Environment& environment,
                             const fish::SpeciesParameters& parameters,
                             std::uint32_t fish,
                             glm::vec3 position);

}  // namespace aquarama::behaviour
