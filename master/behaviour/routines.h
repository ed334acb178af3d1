// SPDX-License-Identifier: Apache-2.0
// The behaviour routines (Tu 1996, section 5.6), one step of each. A routine answers with a course,
// may move its own stage in `mind`, and reports events that others must learn of. What it is given
// does not change meanwhile: fish may act in any order, on any thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "common/units/units.h"
#include "master/behaviour/perceive.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"
#include "master/fish/secondary_controller.h"

namespace aquarama::behaviour {

// What every routine is given.
struct Situation {
    const Environment& environment;
    const fish::SpeciesParameters& parameters;
    std::uint32_t fish;
    const Senses& senses;
    const fish::Feelings& feelings;
};

// With room for one of each fish of a chunk.
using DeferredEvents = std::vector<fish::DeferredEvent>;

// The last stage of a thought: a step of the routine of the intention.
[[nodiscard]] fish::Course act(const Situation& situation,
                               fish::Mind& mind,
                               DeferredEvents& events);

// Slows, or turns away from the fish that is in its sensitivity box, by where that one is and where
// it heads (section 5.6.1).
[[nodiscard]] fish::Course avoidFish(const Situation& situation, const fish::Mind& mind);

// Turns away from sand, rock, plant, surface or submarine. A member of a school keeps company
// meanwhile; others look to their way alone.
[[nodiscard]] fish::Course avoidObstacle(const Situation& situation, const fish::Mind& mind);
// Where the surroundings push, as a way round: what would only throw the fish back turns it to the
// side on which it gets past sooner.
[[nodiscard]] glm::vec3 wayRound(const Situation& situation);

// Goes for the particle of its intention and snaps at it: what is in a small cone before the mouth
// is drawn in with the water (section 5.6.3).
[[nodiscard]] fish::Course eat(const Situation& situation,
                               fish::Mind& mind,
                               DeferredEvents& events);
// Whether a thing is where the mouth's suction reaches; offset is from the body frame's origin,
// metres.
[[nodiscard]] bool isBeforeTheMouth(const Senses& senses, glm::vec3 offset);

// Flees from all predators in sight, the nearer the more, as fast as it can, out of the way of all
// who flee beside it (section 5.6.4). A fish of a school leaves it only as the predator comes near,
// so that a hollow opens about the attacker and closes behind it.
[[nodiscard]] fish::Course escape(const Situation& situation, const fish::Mind& mind);

// Of Mind::stage while a predator is about a prey.
enum class HuntStage : std::uint8_t { Stalk, Rush };
// A predator's meal (section 5.6.5): it goes slowly for its prey, rushes at it from near, and snaps
// when it is at the mouth. Prey that turns more sharply gets away.
[[nodiscard]] fish::Course hunt(const Situation& situation,
                                fish::Mind& mind,
                                DeferredEvents& events);

// Leaves for water whose light and warmth suit its habits: in our sea both change with height
// alone, so it climbs or dives.
[[nodiscard]] fish::Course leave(const Situation& situation);
// The nearest height (y, negative) within the water at which light and warmth suit the species, or
// where they do least ill.
[[nodiscard]] float suitableHeight(const Situation& situation);

// Mating (section 5.6.6): a fish follows one that courts nobody, shows itself to one that courts
// another, and with one that courts it goes through a courtship. Each has its time; then the fish
// gives up.
[[nodiscard]] fish::Course mate(const Situation& situation,
                                fish::Mind& mind,
                                DeferredEvents& events);

// Swims with the school: separation, alignment and cohesion with the nearest seen, the school's
// common way, and no global control.
[[nodiscard]] fish::Course school(const Situation& situation);
// How far from its goal a school of so many fish reaches at ease.
[[nodiscard]] float schoolRadiusMetres(std::size_t fish);
// Of a bait ball every fish keeps a level of its own, -1 at its bottom to 1 at its top, more of
// them near the middle; else all would mill in one flat ring.
[[nodiscard]] float levelInBall(std::uint32_t seed, std::uint32_t fish);

// Goes about as its species does at ease (Habits): its paces, its home, its partner, its turns for
// no reason.
[[nodiscard]] fish::Course wander(const Situation& situation);
// Body lengths a second, by the shares of Habits::paces; another every five seconds.
[[nodiscard]] float paceOf(const fish::SpeciesParameters& parameters,
                           std::uint32_t seed,
                           std::uint32_t fish,
                           Tick tick);

}  // namespace aquarama::behaviour
