// SPDX-License-Identifier: Apache-2.0
// The destinations of a fish at ease: around its home, along its beat, or in all its water.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "common/base/units.h"
#include "common/config/species.h"
#include "common/place/place.h"
#include "master/behaviour/perceive.h"
#include "master/fish/fish_view.h"
#include "master/surroundings/surroundings.h"

namespace aquarama::behaviour {

// A point in the water for a fish to swim to, near the depth that its species likes best. Another
// one every 15 s.
[[nodiscard]] glm::vec3 wanderingGoal(std::uint32_t seed,
                                      const place::Region& water,
                                      float bestDepthMetres,
                                      std::size_t fish,
                                      Tick tick);

// Homes of a species and how many fish share one, in the order of its fish.
struct Homes {
    std::vector<glm::vec3> places;  // metres; empty where the species keeps to no place
    std::uint32_t fishAtEach = 1;
};
// The homes of `fish` fish of a species, the first of which has this index. With wanted places, in
// plan, one group at each: at the nearest site of the kind that the species asks for, or over the
// nearest boulder. Without, the groups take the sites in their order, or boulders drawn by the
// seed. In open water where there is no boulder.
[[nodiscard]] Homes homesOf(const surroundings::Surroundings& surroundings,
                            const config::Habits& habits,
                            std::span<const glm::vec2> wanted,
                            std::uint32_t firstOfKind,
                            std::uint32_t fish);
// The home of a fish of a species that keeps to a place.
[[nodiscard]] glm::vec3 homeOf(const fish::SpeciesParameters& parameters, std::uint32_t fish);

// The next point of a predator's beat about a bait ball: an oval near the borders of the water, and
// from time to time through the middle of the ball.
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
// Chooses the destination by the home or role of the species; a predator without a home patrols
// (patrolGoal()), or about a bait ball swims its beat.
[[nodiscard]] Bound boundFor(const Environment& environment,
                             const fish::SpeciesParameters& parameters,
                             std::uint32_t fish,
                             glm::vec3 position);

}  // namespace aquarama::behaviour
