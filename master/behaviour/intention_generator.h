// SPDX-License-Identifier: Apache-2.0
// The intention generator (Tu & Terzopoulos 1994, section 6.2): collision first, then fear, then
// what was interrupted, then hunger or libido, whichever is stronger, then habits. Pure functions
// of one fish.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

#include "master/behaviour/perceive.h"
#include "master/behaviour/routines.h"
#include "master/behaviour/think.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"

namespace aquarama::behaviour {

// The result of a thought: what the fish will do, with which target, and how alarmed it is.
struct Decision {
    fish::Intention intention = fish::Intention::Wander;
    std::uint32_t target = fish::kNobody;
    fish::Alarm alarm = fish::Alarm::Calm;
};

// The first rule that wins, in the order of PriorityRule. O(1).
[[nodiscard]] Decision decide(const fish::SpeciesParameters& parameters,
                              const fish::Mind& mind,
                              const Senses& senses,
                              const fish::Feelings& feelings);

// Takes a decision into the mind: what it interrupts is remembered, what it resumes is forgotten. A
// new aim resets the stage and the clock of the aim.
void remember(fish::Mind& mind, const Decision& decision);

// The rules of decide(), in their order, with the intention that each stands for.
enum class PriorityRule : std::uint8_t {
    Obstacle,   // AvoidObstacle
    Shelter,    // Hide
    OtherFish,  // AvoidFish
    Fear,       // School or Escape, from a predator or from who charges it
    Rest,       // Rest, outside the active hours of the species
    Territory,  // Charge
    Memory,     // what was interrupted
    Cleaning,   // Clean or Visit
    Hunger,     // Eat
    Libido,     // Mate
    Climate,    // Leave
    Company,    // School
    // Graze, Hover, Clean or Wander: always wins.
    Ease,
};
inline constexpr std::size_t kPriorityRules = 13;

// The verdict on a rule.
enum class Verdict : std::uint8_t {
    Wins,
    Outranked,      // would have won, but a rule before it did
    AgainstHabits,  // its role or habits do not allow it
    TooWeak,        // value is not above threshold
    // Wanted, but nothing of the kind is in view (Climate: no other height is better).
    NoTarget,
    Nothing,  // Memory: nothing was interrupted
    TooOld,   // Memory: interrupted for longer than threshold; forgotten
    // Hunger of a predator, Territory: it rests after a chase or charge.
    Resting,
    Sheltered,  // Fear: a shelter is near, whose rule decides; OtherFish: it rests in one
    Awake,      // Rest: it is active now
    // Hunger or libido: the other one is stronger. Cleaning: it is about a hunt or a courtship.
    Yields,
};

// A rule as it was applied to one fish.
struct Weighed {
    // The intention that the rule stands for.
    fish::Intention intention = fish::Intention::Wander;
    std::uint32_t target = fish::kNobody;
    Verdict verdict = Verdict::Wins;
    // The compared value. Obstacle: urgency. OtherFish: share of the other body in the box. Fear,
    // Hunger, Libido: the feeling. Shelter: the threat. Territory: seconds since the last charge.
    // Memory: seconds since the interruption. Climate: Senses::discomfort. Cleaning: Senses::urge.
    float value = 0;
    float threshold = 0;
};

// How a mind comes to its decision, rule by rule. The same functions as in decide(); for `aquarama
// explain`.
struct Reasoning {
    std::array<Weighed, kPriorityRules> rules;  // by PriorityRule
    Decision decision;
    PriorityRule winner = PriorityRule::Ease;
};
[[nodiscard]] Reasoning reason(const fish::SpeciesParameters& parameters,
                               const fish::Mind& mind,
                               const Senses& senses,
                               const fish::Feelings& feelings);

// Whether the intention allows what the secondary controller recommends (paper, section 5.1).

// Whether a fish may swim another pattern for a while, for variety. Not while every stroke counts:
// near obstacles or other fish, in fear or flight, near its food, in courtship.
[[nodiscard]] bool acceptsRecommendation(const fish::SpeciesParameters& parameters,
                                         const fish::Mind& mind,
                                         const Senses& senses,
                                         const fish::Feelings& feelings);

// Pursuit of a target (Tu 1996, section 5.6.2; paper, section 5.2): a rough direction from far off,
// the exact one and a lower speed when near. Also flight from predators.

// A course to a target. `towards` leads from the body to the target, metres; `speed` is that from
// far off, body lengths a second; `velocity` is that of the target, metres a second: a moving
// target is met where it will be.
[[nodiscard]] fish::Course pursue(const Situation& situation,
                                  glm::vec3 towards,
                                  float speed,
                                  glm::vec3 velocity = {});

// A course along the desired direction (any length), bent by obstacles, no steeper than 25 degrees.
[[nodiscard]] fish::Course heading(const Situation& situation, glm::vec3 desired, float speed);

// The direction no steeper than 58 degrees, of a dive or of a strike from above; a unit vector.
[[nodiscard]] glm::vec3 steeply(glm::vec3 direction);

// A course to a place, relative to the fish, and then one that keeps it against the current. It is
// there within so many metres.
[[nodiscard]] fish::Course keptPlace(const Situation& situation, glm::vec3 towards, float metres);

// Direction of flight from who charges it and from the predators in sight, a unit vector; zero
// where there is none. Nearer predators count more. A fish before an approaching predator goes
// aside rather than ahead and so slips round behind it: the fountain manoeuvre of a school (Hall,
// Wardle & MacLennan 1986).
[[nodiscard]] glm::vec3 flightFrom(const Situation& situation);

}  // namespace aquarama::behaviour
