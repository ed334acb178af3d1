// SPDX-License-Identifier: Apache-2.0
// The intention generator (Tu & Terzopoulos 1994, section 6.2): collision first, then fear, then
// what was interrupted, then hunger and libido by strength, then habits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "master/behaviour/mental_state.h"
#include "master/behaviour/perceive.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"

namespace aquarama::behaviour {

struct Decision {
    fish::Intention intention = fish::Intention::Wander;
    std::uint32_t target = fish::kNobody;
    fish::Alarm alarm = fish::Alarm::Calm;
};

[[nodiscard]] Decision decide(const fish::SpeciesParameters& parameters,
                              const fish::Mind& mind,
                              const Senses& senses,
                              const fish::Feelings& feelings);

// The mind with the decision taken: what it interrupts is remembered, what it resumes forgotten.
void remember(fish::Mind& mind, const Decision& decision);

// The rules that decide() applies in this order: the first that wins is the decision.
enum class PriorityRule : std::uint8_t {
    Obstacle,   // AvoidObstacle
    OtherFish,  // AvoidFish
    Fear,       // School or Escape
    Memory,     // what was interrupted
    Hunger,     // Eat
    Libido,     // Mate
    Climate,    // Leave
    Company,    // School
    Ease,       // Wander: always wins
};
inline constexpr std::size_t kPriorityRules = 9;

// The result of a rule.
enum class Verdict : std::uint8_t {
    Wins,
    Outranked,      // would have won, but a rule before it did
    AgainstHabits,  // its role or habits do not allow it
    TooWeak,        // value is not above threshold
    NoTarget,       // wanted, but nothing of the kind is in view (Climate: nowhere is better)
    Nothing,        // Memory: nothing was interrupted
    TooOld,         // Memory: interrupted for longer than threshold; forgotten
    Resting,        // Hunger of a predator: the last chase is not long enough ago
    Yields,         // the other of hunger and libido is stronger
};

struct Weighed {
    fish::Intention intention = fish::Intention::Wander;  // that the rule stands for
    std::uint32_t target = fish::kNobody;
    Verdict verdict = Verdict::Wins;
    // Obstacle: urgency. OtherFish: share of the other's body in the box. Fear, Hunger, Libido: the
    // feeling. Memory: seconds since. Climate: Senses::discomfort.
    float value = 0;
    float threshold = 0;
};

// How a mind came to its decision: rule by rule, by the same functions that decide() applies.
struct Reasoning {
    std::array<Weighed, kPriorityRules> rules;  // by PriorityRule
    Decision decision;
    PriorityRule winner = PriorityRule::Ease;
};
[[nodiscard]] Reasoning reason(const fish::SpeciesParameters& parameters,
                               const fish::Mind& mind,
                               const Senses& senses,
                               const fish::Feelings& feelings);

// The intention generator's word on what the secondary controller recommends (paper, section 5.1).

// Whether a fish with this intention may swim another pattern for a while, for no reason but
// variety. Not while a stroke counts: in flight, in fear, in another's way, near what it eats, in
// courtship.
[[nodiscard]] bool acceptsRecommendation(const fish::SpeciesParameters& parameters,
                                         const fish::Mind& mind,
                                         const Senses& senses,
                                         const fish::Feelings& feelings);

}  // namespace aquarama::behaviour
