// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/decide/intention_generator.h"

namespace aquarama {

namespace {

constexpr float kDesire = 0.25F;  // r: hunger or libido above this is heeded

bool likesSchooling(const Nature& nature, const Mind& mind) {
    return nature.role == Role::Prey && (mind.likes & kLikesSchooling) != 0;
}

}  // namespace

Decision decide(const Nature& nature,
                const Mind& mind,
                const Senses& senses,
                const Feelings& feelings) {
    if (senses.urgency >= 1) return {Intention::AvoidObstacle};
    if (senses.collision.seen()) return {Intention::AvoidFish, senses.collision.object};
    if (feelings.fear > nature.fearFrom && nature.role == Role::Prey) {
        const bool together =
            feelings.greatestFear < nature.fearAlone && likesSchooling(nature, mind);
        return {together ? Intention::School : Intention::Escape};
    }
    if (feelings.hunger > kDesire && senses.food.seen() && nature.role != Role::Predator)
        return {Intention::Eat, senses.food.object};
    if (likesSchooling(nature, mind)) return {Intention::School};
    return {Intention::Wander};
}

void remember(Mind& mind, const Decision& decision) {
    constexpr std::uint32_t kThought = 8;  // ticks between thoughts
    const auto later = [](std::uint32_t& ticks) {
        if (ticks < kLongAgo) ticks += kThought;
    };
    later(mind.sinceMeal);
    later(mind.sinceSpawning);
    later(mind.sinceStage);
    later(mind.pursued);
    if (decision.intention != mind.intention || decision.target != mind.target) mind.pursued = 0;
    mind.intention = decision.intention;
    mind.target = decision.target;
}

}  // namespace aquarama
