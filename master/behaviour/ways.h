// SPDX-License-Identifier: Apache-2.0
// Where a school goes that nothing gathers: a few bold members choose among the structures of the
// reef, all others follow their neighbours and slow down where they like it.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "master/behaviour/perceive.h"
#include "master/behaviour/routines.h"

namespace aquarama::behaviour {

// One fish in twelve is bold, drawn by the seed.
[[nodiscard]] bool isBold(std::uint32_t seed, std::uint32_t fish);

// What schools remember of the structures, at a tick: the bold fish beside one make it tiring, fish
// of a school that are alarmed beside one make it frightening, and both are forgotten with time.
// Each fish counts once a second, so a tick looks at a sixtieth of them.
void rememberPlaces(const Environment& environment,
                    std::vector<surroundings::Structure>& structures);

// The structure that a bold fish goes to: the present one for 40 to 90 s, then one drawn by how
// much schools like it, what they remember of it, and how near it is; kNobody where there is none.
// A fish that is afraid leaves for another one at once.
[[nodiscard]] std::uint32_t structureFor(const Environment& environment,
                                         const fish::Mind& mind,
                                         std::uint32_t fish,
                                         const Senses& senses);

// How much a school likes to be at a place, 0 to 1: most beside a structure, a little off its
// crown. By the place alone, and now: less where it is tired of it, not at all where it was
// frightened.
struct Liking {
    float place = 0, now = 0;
};
[[nodiscard]] Liking likingOf(const surroundings::Surroundings& surroundings, glm::vec3 place);

// The way that a fish would go by itself, in units of the unit vector of its present course: a bold
// one towards its structure and to the side of it from which the current comes; all against the
// current where they like to be.
[[nodiscard]] glm::vec3 ownWay(const Situation& situation);

}  // namespace aquarama::behaviour
