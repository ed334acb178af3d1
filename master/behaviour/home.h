// SPDX-License-Identifier: Apache-2.0
// Where a fish that wants nothing goes about: its own place, its beat, or all the water.
#pragma once

#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

#include "common/config/species.h"
#include "common/place/place.h"
#include "common/units/units.h"
#include "master/behaviour/perceive.h"
#include "master/fish/fish_view.h"
#include "master/surroundings/obstacles.h"

namespace aquarama::behaviour {

// Where a fish is bound for, in its water, about the depth that its species likes best. Another
// place every quarter of a minute.
[[nodiscard]] glm::vec3 wanderingGoal(std::uint32_t seed,
                                      const place::Region& water,
                                      float bestDepthMetres,
                                      std::size_t fish,
                                      Tick tick);

// The place of a household (a number that fish which live together share): drawn by the seed, over
// a rock where the habit has it so and there is one.
[[nodiscard]] glm::vec3 homeOf(std::uint32_t seed,
                               const config::Home& home,
                               const surroundings::Obstacles& obstacles,
                               float bestDepthMetres,
                               std::uint32_t household);
// Of fish of one species, every two live together.
[[nodiscard]] std::uint32_t householdOf(std::uint32_t firstOfKind, std::uint32_t fish);

// The next point of a predator's beat: an oval near the borders of the water, and now and then
// through the bait ball.
[[nodiscard]] glm::vec3 beatGoal(const Environment& environment,
                                 const fish::SpeciesParameters& parameters,
                                 std::uint32_t fish,
                                 glm::vec3 position);

struct Bound {
    glm::vec3 towards{};  // metres
    float strayed = 0;    // 0 within the range, 1 at the leash and beyond
};
[[nodiscard]] Bound boundFor(const Environment& environment,
                             const fish::SpeciesParameters& parameters,
                             std::uint32_t fish,
                             glm::vec3 position);

}  // namespace aquarama::behaviour
