// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/decide/intention_generator.h"

#include "common/units/ids.h"
#include "master/fish/drives.h"

namespace aquarama::behaviour {

namespace {

constexpr float kTurnAway = 1;       // urgency from which only turning away matters
constexpr float kTurnedAway = 0.7F;  // and down to which a fish goes on with it
constexpr float kMemorySeconds = 12;
// Of hunger and libido the other one must be stronger by this, and the one pursued for so long.
constexpr float kPreference = 0.1F;
constexpr float kLeastPursuitSeconds = 2;
constexpr float kUneasy = 0.02F;   // of Senses::discomfort: leave from here on
constexpr float kAtEase = -0.02F;  // and until here

float seconds(std::uint32_t ticks) {
    return static_cast<float>(ticks) / static_cast<float>(kTicksPerSecond);
}

bool likesSchooling(const fish::Nature& nature, const fish::Mind& mind) {
    return nature.habits.role == config::Role::Prey && (mind.likes & fish::kLikesSchooling) != 0;
}

// Prey alone heeds its fear. A school shelters from a lesser one, where there is a school.
fish::Alarm alarmOf(const fish::Nature& nature,
                    const fish::Mind& mind,
                    const Senses& senses,
                    const Feelings& feelings) {
    if (nature.habits.role != config::Role::Prey) return fish::Alarm::Calm;
    const float heeded =
        nature.habits.fearFrom * (mind.alarm == fish::Alarm::Calm ? 1 : fish::kHysteresis);
    if (feelings.fear <= heeded) return fish::Alarm::Calm;
    const float alone =
        nature.habits.fearAlone * (mind.alarm == fish::Alarm::Alone ? fish::kHysteresis : 1);
    const bool together = feelings.greatestFear < alone && likesSchooling(nature, mind) &&
                          senses.schoolmates.count > 0;
    return together ? fish::Alarm::Together : fish::Alarm::Alone;
}

// One rung of the ladder is one function; each knows nothing of the others.
struct Case {
    const fish::Nature& nature;
    const fish::Mind& mind;
    const Senses& senses;
    const Feelings& feelings;
    fish::Aim aim = fish::aimOf(mind);
    fish::Alarm alarm = alarmOf(nature, mind, senses, feelings);

    [[nodiscard]] Weighed obstacle() const {
        const bool turning = mind.intention == fish::Intention::AvoidObstacle;
        const float threshold = turning ? kTurnedAway : kTurnAway;
        return {fish::Intention::AvoidObstacle,
                fish::kNobody,
                senses.urgency >= threshold ? Verdict::Wins : Verdict::TooWeak,
                senses.urgency,
                threshold};
    }

    [[nodiscard]] Weighed otherFish() const {
        return {fish::Intention::AvoidFish,
                senses.collision.object,
                senses.collision.seen() ? Verdict::Wins : Verdict::NoTarget,
                senses.collisionShare,
                0};
    }

    [[nodiscard]] Weighed fear() const {
        Weighed rung{
            alarm == fish::Alarm::Together ? fish::Intention::School : fish::Intention::Escape,
            alarm == fish::Alarm::Together ? fish::kNobody : senses.predators[0].object,
            Verdict::Wins,
            feelings.fear,
            nature.habits.fearFrom * (mind.alarm == fish::Alarm::Calm ? 1 : fish::kHysteresis)};
        if (nature.habits.role != config::Role::Prey)
            rung.verdict = Verdict::AgainstNature;
        else if (alarm == fish::Alarm::Calm)
            rung.verdict = Verdict::TooWeak;
        return rung;
    }

    [[nodiscard]] Weighed memory() const {
        Weighed rung{mind.remembered,
                     mind.rememberedTarget,
                     Verdict::Wins,
                     seconds(mind.sinceRemembered),
                     kMemorySeconds};
        if (mind.remembered == fish::Intention::Wander)
            rung.verdict = Verdict::Nothing;
        else if (rung.value > kMemorySeconds)
            rung.verdict = Verdict::TooOld;
        else if (!canGoOn())
            rung.verdict = Verdict::NoTarget;
        return rung;
    }

    // What was interrupted is resumed with the same target alone.
    [[nodiscard]] bool canGoOn() const {
        if (mind.remembered == fish::Intention::Eat) {
            const Weighed now = hunger();
            return now.verdict == Verdict::Wins && now.target == mind.rememberedTarget;
        }
        if (mind.remembered == fish::Intention::Mate)
            return senses.mate.seen() && senses.mate.object == mind.rememberedTarget;
        return likesSchooling(nature, mind);
    }

    [[nodiscard]] float desireFor(fish::Intention aimed) const {
        return aim.intention == aimed ? fish::kDesire * fish::kHysteresis : fish::kDesire;
    }

    [[nodiscard]] const Sighting& meal() const {
        return nature.habits.role == config::Role::Predator ? senses.prey : senses.food;
    }

    [[nodiscard]] bool isRestingFromAChase() const {
        if (nature.habits.role != config::Role::Predator) return false;
        const float since = seconds(mind.sinceChase);
        return aim.intention == fish::Intention::Eat
                   ? since > static_cast<float>(nature.habits.hunt.chaseSeconds)
                   : since < static_cast<float>(nature.habits.hunt.restSeconds);
    }

    [[nodiscard]] Weighed hunger() const {
        Weighed rung{fish::Intention::Eat,
                     meal().object,
                     Verdict::Wins,
                     feelings.hunger,
                     desireFor(fish::Intention::Eat)};
        if (rung.value <= rung.threshold)
            rung.verdict = Verdict::TooWeak;
        else if (isRestingFromAChase())
            rung.verdict = Verdict::Resting;
        else if (!meal().seen())
            rung.verdict = Verdict::NoTarget;
        else if (wouldMate() && !hungerIsStronger())
            rung.verdict = Verdict::Yields;
        return rung;
    }

    [[nodiscard]] bool wouldMate() const {
        return fish::mates(nature) && feelings.libido > desireFor(fish::Intention::Mate) &&
               senses.mate.seen();
    }
    [[nodiscard]] bool wouldEat() const {
        return feelings.hunger > desireFor(fish::Intention::Eat) && meal().seen();
    }
    // The published comparison H > L; what is being done already is preferred.
    [[nodiscard]] bool hungerIsStronger() const {
        const bool justBegun = seconds(mind.pursued) < kLeastPursuitSeconds;
        if (aim.intention == fish::Intention::Eat)
            return justBegun || feelings.hunger + kPreference >= feelings.libido;
        if (aim.intention == fish::Intention::Mate)
            return !justBegun && feelings.hunger > feelings.libido + kPreference;
        return feelings.hunger >= feelings.libido;
    }

    [[nodiscard]] Weighed libido() const {
        Weighed rung{fish::Intention::Mate,
                     senses.mate.object,
                     Verdict::Wins,
                     feelings.libido,
                     desireFor(fish::Intention::Mate)};
        if (!fish::mates(nature))
            rung.verdict = Verdict::AgainstNature;
        else if (rung.value <= rung.threshold)
            rung.verdict = Verdict::TooWeak;
        else if (!senses.mate.seen())
            rung.verdict = Verdict::NoTarget;
        else if (wouldEat() && hungerIsStronger())
            rung.verdict = Verdict::Yields;
        return rung;
    }

    [[nodiscard]] Weighed climate() const {
        const float threshold = aim.intention == fish::Intention::Leave ? kAtEase : kUneasy;
        Weighed rung{
            fish::Intention::Leave, fish::kNobody, Verdict::Wins, senses.discomfort, threshold};
        if (nature.habits.role == config::Role::Predator)
            rung.verdict = Verdict::AgainstNature;
        else if (senses.discomfort <= threshold)
            rung.verdict = Verdict::TooWeak;
        else if (senses.betterUp == 0)
            rung.verdict = Verdict::NoTarget;
        return rung;
    }

    [[nodiscard]] Weighed company() const {
        return {fish::Intention::School,
                fish::kNobody,
                likesSchooling(nature, mind) ? Verdict::Wins : Verdict::AgainstNature,
                0,
                0};
    }
};

// Visits the rungs in the order of their priority, until the visitor says that it is enough.
template <class IsEnough>
void climbDown(const Case& of, const IsEnough& isEnough) {
    if (isEnough(Rung::Obstacle, of.obstacle())) return;
    if (isEnough(Rung::OtherFish, of.otherFish())) return;
    if (isEnough(Rung::Fear, of.fear())) return;
    if (isEnough(Rung::Memory, of.memory())) return;
    if (isEnough(Rung::Hunger, of.hunger())) return;
    if (isEnough(Rung::Libido, of.libido())) return;
    if (isEnough(Rung::Climate, of.climate())) return;
    if (isEnough(Rung::Company, of.company())) return;
    isEnough(Rung::Ease, Weighed{});
}

}  // namespace

Decision decide(const fish::Nature& nature,
                const fish::Mind& mind,
                const Senses& senses,
                const Feelings& feelings) {
    const Case of{nature, mind, senses, feelings};
    Decision decision{.alarm = of.alarm};
    climbDown(of, [&](Rung, const Weighed& rung) {
        if (rung.verdict != Verdict::Wins) return false;
        decision.intention = rung.intention;
        decision.target = rung.target;
        return true;
    });
    return decision;
}

Reasoning reason(const fish::Nature& nature,
                 const fish::Mind& mind,
                 const Senses& senses,
                 const Feelings& feelings) {
    const Case of{nature, mind, senses, feelings};
    Reasoning reasoning;
    reasoning.decision.alarm = of.alarm;
    bool won = false;
    climbDown(of, [&](Rung rung, const Weighed& weighed) {
        Weighed& noted = reasoning.rungs[static_cast<std::size_t>(rung)];
        noted = weighed;
        if (weighed.verdict != Verdict::Wins) return false;
        if (won) {
            noted.verdict = Verdict::Outranked;
            return false;
        }
        won = true;
        reasoning.winner = rung;
        reasoning.decision.intention = weighed.intention;
        reasoning.decision.target = weighed.target;
        return false;
    });
    return reasoning;
}

void remember(fish::Mind& mind, const Decision& decision) {
    const fish::Aim before = fish::aimOf(mind);
    if (!fish::interrupts(decision.intention, decision.alarm)) {
        mind.remembered = fish::Intention::Wander;
        mind.rememberedTarget = fish::kNobody;
    } else if (!fish::interrupts(mind.intention, mind.alarm) &&
               mind.intention >= fish::Intention::School) {
        // Eat, mate and school are worth resuming.
        mind.remembered = mind.intention;
        mind.rememberedTarget = mind.target;
        mind.sinceRemembered = 0;
    }
    mind.intention = decision.intention;
    mind.target = decision.target;
    mind.alarm = decision.alarm;
    const fish::Aim after = fish::aimOf(mind);
    if (after == before) return;
    mind.pursued = 0;
    mind.stage = 0;
    mind.sinceStage = 0;
    const bool chased = before.intention == fish::Intention::Eat;
    const bool chases = after.intention == fish::Intention::Eat;
    if (chased != chases) mind.sinceChase = 0;
}

}  // namespace aquarama::behaviour
