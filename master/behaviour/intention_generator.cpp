// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/intention_generator.h"

#include "common/base/units.h"
#include "master/behaviour/cleaning.h"
#include "master/behaviour/territory.h"
#include "master/fish/minds.h"

namespace aquarama::behaviour {

namespace {

// Urgency from which a fish avoids obstacles, and down to which it goes on doing so.
constexpr float kAvoidsFrom = 1;
constexpr float kTurnedAway = 0.7F;
// Threat from which a fish dives, and at which it stays hidden.
constexpr float kDivesFor = 1;
constexpr float kStaysFor = 0.2F;
// A fish that rests so near to its shelter makes room for nobody.
constexpr float kRestsInMetres = 0.6F;
// An interrupted intention is forgotten after this.
constexpr float kMemorySeconds = 12;
// To take over, hunger or libido must be stronger than the other by kPreference, and the other must
// have been pursued for kLeastPursuitSeconds.
constexpr float kPreference = 0.1F;
constexpr float kLeastPursuitSeconds = 2;
// Senses::discomfort from which a fish leaves, and at which it stops leaving.
constexpr float kUneasy = 0.02F;
constexpr float kAtEase = -0.02F;
// Senses::urge from which a fish visits a cleaner, and at which it stays with it.
constexpr float kVisitsFor = 1;
constexpr float kStaysWithCleaner = 0.5F;

bool likesSchooling(const fish::SpeciesParameters& parameters, const fish::Mind& mind) {
    return parameters.habits.role == config::Role::Prey &&
           (mind.likes & fish::kLikesSchooling) != 0;
}

// The fear that a fish heeds, f0, and that in which it flees alone, f1, with hysteresis.
float heededFrom(const fish::SpeciesParameters& parameters, const fish::Mind& mind) {
    return parameters.habits.fear.from * (mind.alarm == fish::Alarm::Calm ? 1 : fish::kHysteresis);
}
float aloneFrom(const fish::SpeciesParameters& parameters, const fish::Mind& mind) {
    return parameters.habits.fear.alone *
           (mind.alarm == fish::Alarm::Alone ? fish::kHysteresis : 1);
}

// Only species that are hunted heed their fear. A schooling fish shelters in the school while the
// fear of each predator is below f1 and there is a school. All thresholds have hysteresis.
fish::Alarm alarmOf(const fish::SpeciesParameters& parameters,
                    const fish::Mind& mind,
                    const Senses& senses,
                    const fish::Feelings& feelings) {
    if (!fish::flees(parameters)) return fish::Alarm::Calm;
    if (feelings.fear <= heededFrom(parameters, mind)) return fish::Alarm::Calm;
    const bool together = feelings.greatestFear < aloneFrom(parameters, mind) &&
                          likesSchooling(parameters, mind) && senses.schoolmates.count > 0;
    return together ? fish::Alarm::Together : fish::Alarm::Alone;
}

// Those intentions have rules of their own, before that of the memory.
bool hasRuleBeforeMemory(fish::Intention intention) {
    return intention == fish::Intention::Hide || intention == fish::Intention::Rest ||
           intention == fish::Intention::Charge;
}

bool isOfCleaning(fish::Intention intention) {
    return intention == fish::Intention::Clean || intention == fish::Intention::Visit;
}

// One thought: what the rules compare. There is one function for each rule; none knows the others.
struct Case {
    const fish::SpeciesParameters& parameters;
    const fish::Mind& mind;
    const Senses& senses;
    const fish::Feelings& feelings;
    fish::Aim aim = fish::aimOf(mind);
    fish::Alarm alarm = alarmOf(parameters, mind, senses, feelings);

    [[nodiscard]] Weighed obstacle() const {
        const bool turning = mind.intention == fish::Intention::AvoidObstacle;
        const float threshold = turning ? kTurnedAway : kAvoidsFrom;
        return {fish::Intention::AvoidObstacle,
                fish::kNobody,
                senses.urgency >= threshold ? Verdict::Wins : Verdict::TooWeak,
                senses.urgency,
                threshold};
    }

    [[nodiscard]] bool staysHidden() const {
        return aim.intention == fish::Intention::Hide && !senses.shelter.venturesOut;
    }

    // A hidden fish stays until nothing threatens it and it ventures out.
    [[nodiscard]] Weighed shelter() const {
        const bool hides = aim.intention == fish::Intention::Hide;
        Weighed rule{fish::Intention::Hide,
                     senses.shelter.site.object,
                     Verdict::Wins,
                     feelings.threat,
                     hides ? kStaysFor : kDivesFor};
        if (parameters.habits.hidesIn.empty())
            rule.verdict = Verdict::AgainstHabits;
        else if (!senses.shelter.site.seen())
            rule.verdict = Verdict::NoTarget;
        else if (rule.value < rule.threshold && !staysHidden())
            rule.verdict = Verdict::TooWeak;
        return rule;
    }

    [[nodiscard]] Weighed otherFish() const {
        const bool isInShelter =
            aim.intention == fish::Intention::Rest && senses.shelter.site.distance < kRestsInMetres;
        return {fish::Intention::AvoidFish,
                senses.collision.object,
                isInShelter               ? Verdict::Sheltered
                : senses.collision.seen() ? Verdict::Wins
                                          : Verdict::NoTarget,
                senses.collisionShare,
                0};
    }

    // In a shelter, where one is known.
    [[nodiscard]] Weighed rest() const {
        Weighed rule{.intention = fish::Intention::Rest, .target = senses.shelter.site.object};
        if (parameters.habits.hours.active == config::Activity::Always)
            rule.verdict = Verdict::AgainstHabits;
        else if (!senses.hour.rests)
            rule.verdict = Verdict::Awake;
        return rule;
    }

    // A predator comes before who charges it.
    [[nodiscard]] bool fleesCharger() const {
        return senses.territory.charger.seen() && alarm == fish::Alarm::Calm;
    }

    [[nodiscard]] Weighed fear() const {
        if (fleesCharger())
            return {fish::Intention::Escape, senses.territory.charger.object, Verdict::Wins, 1, 0};
        Weighed rule = alarm == fish::Alarm::Together
                           ? Weighed{fish::Intention::School, fish::kNobody}
                           : Weighed{fish::Intention::Escape, senses.predators[0].object};
        rule.value = feelings.fear;
        rule.threshold = heededFrom(parameters, mind);
        if (!fish::flees(parameters))
            rule.verdict = Verdict::AgainstHabits;
        else if (senses.shelter.site.seen())
            rule.verdict = Verdict::Sheltered;
        else if (alarm == fish::Alarm::Calm)
            rule.verdict = Verdict::TooWeak;
        return rule;
    }

    [[nodiscard]] Weighed territory() const {
        Weighed rule{fish::Intention::Charge,
                     senses.territory.intruder.object,
                     Verdict::Wins,
                     secondsOfTicks(mind.sinceCharge),
                     kRefractorySeconds};
        if (!senses.territory.holds)
            rule.verdict = Verdict::AgainstHabits;
        else if (aim.intention != fish::Intention::Charge && rule.value < rule.threshold)
            rule.verdict = Verdict::Resting;
        else if (!senses.territory.intruder.seen())
            rule.verdict = Verdict::NoTarget;
        return rule;
    }

    [[nodiscard]] Weighed memory() const {
        Weighed rule{mind.remembered,
                     mind.rememberedTarget,
                     Verdict::Wins,
                     secondsOfTicks(mind.sinceRemembered),
                     kMemorySeconds};
        if (mind.remembered == fish::Intention::Wander)
            rule.verdict = Verdict::Nothing;
        else if (rule.value > kMemorySeconds)
            rule.verdict = Verdict::TooOld;
        else if (!canGoOn())
            rule.verdict = Verdict::NoTarget;
        return rule;
    }

    [[nodiscard]] bool remembers(const Sighting& target) const {
        return target.seen() && target.object == mind.rememberedTarget;
    }
    [[nodiscard]] bool remembers(const Weighed& now) const {
        return now.verdict == Verdict::Wins && now.target == mind.rememberedTarget;
    }

    // An intention is resumed only with the target that it had.
    [[nodiscard]] bool canGoOn() const {
        if (hasRuleBeforeMemory(mind.remembered)) return false;
        if (isOfCleaning(mind.remembered)) return remembers(cleaning());
        if (mind.remembered == fish::Intention::Eat) return remembers(hunger());
        if (mind.remembered == fish::Intention::Graze) return remembers(senses.patch);
        if (mind.remembered == fish::Intention::Mate) return remembers(senses.mate);
        return likesSchooling(parameters, mind);
    }

    // Senses::urge from which it takes part; a cleaner always does.
    [[nodiscard]] float urgeNeeded() const {
        if (parameters.habits.cleans) return 0;
        return aim.intention == fish::Intention::Visit ? kStaysWithCleaner : kVisitsFor;
    }

    // Whether it is about a hunt or a courtship, which come before cleaning.
    [[nodiscard]] bool isBusy() const {
        const bool hunts = parameters.habits.role == config::Role::Predator &&
                           aim.intention == fish::Intention::Eat;
        return hunts || aim.intention == fish::Intention::Mate;
    }

    [[nodiscard]] bool takesPartInCleaning() const {
        return parameters.habits.cleans || goesToCleaners(parameters, senses.length);
    }

    // The client of a cleaner, or the cleaner of a client.
    [[nodiscard]] const Sighting& partnerInCleaning() const {
        return parameters.habits.cleans ? senses.cleaning.client : senses.cleaning.cleaner;
    }

    [[nodiscard]] Weighed cleaning() const {
        const Sighting& other = partnerInCleaning();
        Weighed rule{parameters.habits.cleans ? fish::Intention::Clean : fish::Intention::Visit,
                     other.object,
                     Verdict::Wins,
                     senses.cleaning.urge,
                     urgeNeeded()};
        if (!takesPartInCleaning())
            rule.verdict = Verdict::AgainstHabits;
        else if (rule.value < rule.threshold)
            rule.verdict = Verdict::TooWeak;
        else if (!other.seen())
            rule.verdict = Verdict::NoTarget;
        else if (isBusy())
            rule.verdict = Verdict::Yields;
        return rule;
    }

    // Threshold of a drive, lower for the one that is pursued (hysteresis).
    [[nodiscard]] float desireFor(fish::Intention aimed) const {
        return aim.intention == aimed ? fish::kDesire * fish::kHysteresis : fish::kDesire;
    }

    // Prey for a predator, a particle for the others.
    [[nodiscard]] const Sighting& meal() const {
        return parameters.habits.role == config::Role::Predator ? senses.prey : senses.food;
    }

    // While hunting: the chase has lasted too long. Else: the last one ended too recently.
    [[nodiscard]] bool isRestingFromAChase() const {
        if (parameters.habits.role != config::Role::Predator) return false;
        const config::Hunt& hunt = parameters.habits.hunt;
        const float since = secondsOfTicks(mind.sinceChase);
        const auto byDay = static_cast<float>(hunt.restByDaySeconds);
        const float rest =
            byDay + (static_cast<float>(hunt.restSeconds) - byDay) * senses.huntersActive;
        return aim.intention == fish::Intention::Eat ? since > static_cast<float>(hunt.chaseSeconds)
                                                     : since < rest;
    }

    [[nodiscard]] Weighed hunger() const {
        Weighed rule{fish::Intention::Eat,
                     meal().object,
                     Verdict::Wins,
                     feelings.hunger,
                     desireFor(fish::Intention::Eat)};
        if (rule.value <= rule.threshold)
            rule.verdict = Verdict::TooWeak;
        else if (isRestingFromAChase())
            rule.verdict = Verdict::Resting;
        else if (!meal().seen())
            rule.verdict = Verdict::NoTarget;
        else if (wouldMate() && !hungerIsStronger())
            rule.verdict = Verdict::Yields;
        return rule;
    }

    [[nodiscard]] bool wouldMate() const {
        return fish::mates(parameters) && feelings.libido > desireFor(fish::Intention::Mate) &&
               senses.mate.seen();
    }
    [[nodiscard]] bool wouldEat() const {
        return feelings.hunger > desireFor(fish::Intention::Eat) && !isRestingFromAChase() &&
               meal().seen();
    }
    // H > L as published, but with a preference for the drive that is pursued already.
    [[nodiscard]] bool hungerIsStronger() const {
        const bool justBegun = secondsOfTicks(mind.pursued) < kLeastPursuitSeconds;
        if (aim.intention == fish::Intention::Eat)
            return justBegun || feelings.hunger + kPreference >= feelings.libido;
        if (aim.intention == fish::Intention::Mate)
            return !justBegun && feelings.hunger > feelings.libido + kPreference;
        return feelings.hunger >= feelings.libido;
    }

    [[nodiscard]] Weighed libido() const {
        Weighed rule{fish::Intention::Mate,
                     senses.mate.object,
                     Verdict::Wins,
                     feelings.libido,
                     desireFor(fish::Intention::Mate)};
        if (!fish::mates(parameters))
            rule.verdict = Verdict::AgainstHabits;
        else if (rule.value <= rule.threshold)
            rule.verdict = Verdict::TooWeak;
        else if (!senses.mate.seen())
            rule.verdict = Verdict::NoTarget;
        else if (wouldEat() && hungerIsStronger())
            rule.verdict = Verdict::Yields;
        return rule;
    }

    [[nodiscard]] Weighed climate() const {
        const float threshold = aim.intention == fish::Intention::Leave ? kAtEase : kUneasy;
        Weighed rule{fish::Intention::Leave,
                     fish::kNobody,
                     Verdict::Wins,
                     senses.climate.discomfort,
                     threshold};
        if (parameters.habits.role == config::Role::Predator)
            rule.verdict = Verdict::AgainstHabits;
        else if (senses.climate.discomfort <= threshold)
            rule.verdict = Verdict::TooWeak;
        else if (senses.climate.betterUp == 0)
            rule.verdict = Verdict::NoTarget;
        return rule;
    }

    [[nodiscard]] Weighed company() const {
        return {fish::Intention::School,
                senses.structure,
                likesSchooling(parameters, mind) ? Verdict::Wins : Verdict::AgainstHabits,
                0,
                0};
    }

    [[nodiscard]] Weighed ease() const {
        if (senses.patch.seen()) return {fish::Intention::Graze, senses.patch.object};
        if (parameters.habits.cloud) return {.intention = fish::Intention::Hover};
        return {.intention =
                    parameters.habits.cleans ? fish::Intention::Clean : fish::Intention::Wander};
    }
};

// Applies the rules in order until isEnough(rule, weighed) is true.
template <class IsEnough>
void applyRules(const Case& of, const IsEnough& isEnough) {
    if (isEnough(PriorityRule::Obstacle, of.obstacle())) return;
    if (isEnough(PriorityRule::Shelter, of.shelter())) return;
    if (isEnough(PriorityRule::OtherFish, of.otherFish())) return;
    if (isEnough(PriorityRule::Fear, of.fear())) return;
    if (isEnough(PriorityRule::Rest, of.rest())) return;
    if (isEnough(PriorityRule::Territory, of.territory())) return;
    if (isEnough(PriorityRule::Memory, of.memory())) return;
    if (isEnough(PriorityRule::Cleaning, of.cleaning())) return;
    if (isEnough(PriorityRule::Hunger, of.hunger())) return;
    if (isEnough(PriorityRule::Libido, of.libido())) return;
    if (isEnough(PriorityRule::Climate, of.climate())) return;
    if (isEnough(PriorityRule::Company, of.company())) return;
    isEnough(PriorityRule::Ease, of.ease());
}

// Urgency up to which another pattern is allowed.
constexpr float kCalm = 0.15F;
// Beyond this distance a fish only swims in the direction of its food.
constexpr float kMealIsFarBodyLengths = 6.0F;

bool isFarFromMeal(const fish::SpeciesParameters& parameters, const Senses& senses) {
    const Sighting& meal =
        parameters.habits.role == config::Role::Predator ? senses.prey : senses.food;
    return meal.distance > kMealIsFarBodyLengths * senses.length;
}

}  // namespace

Decision decide(const fish::SpeciesParameters& parameters,
                const fish::Mind& mind,
                const Senses& senses,
                const fish::Feelings& feelings) {
    const Case of{parameters, mind, senses, feelings};
    Decision decision{.alarm = of.alarm};
    applyRules(of, [&](PriorityRule, const Weighed& rule) {
        if (rule.verdict != Verdict::Wins) return false;
        decision.intention = rule.intention;
        decision.target = rule.target;
        return true;
    });
    return decision;
}

Reasoning reason(const fish::SpeciesParameters& parameters,
                 const fish::Mind& mind,
                 const Senses& senses,
                 const fish::Feelings& feelings) {
    const Case of{parameters, mind, senses, feelings};
    Reasoning reasoning;
    reasoning.decision.alarm = of.alarm;
    bool won = false;
    applyRules(of, [&](PriorityRule rule, const Weighed& weighed) {
        Weighed& noted = reasoning.rules[static_cast<std::size_t>(rule)];
        noted = weighed;
        if (weighed.verdict != Verdict::Wins) return false;
        if (won) {
            noted.verdict = Verdict::Outranked;
            return false;
        }
        won = true;
        reasoning.winner = rule;
        reasoning.decision.intention = weighed.intention;
        reasoning.decision.target = weighed.target;
        return false;
    });
    return reasoning;
}

namespace {

// Remembers what a decision interrupts; else forgets what was remembered.
void rememberInterrupted(fish::Mind& mind, const Decision& decision) {
    // An obstacle alone interrupts a fish that hides: where another rule wins, it hides no more.
    const bool hidNoMore = fish::aimOf(mind).intention == fish::Intention::Hide &&
                           decision.intention != fish::Intention::AvoidObstacle;
    if (!fish::interrupts(decision.intention, decision.alarm) || hidNoMore) {
        mind.remembered = fish::Intention::Wander;
        mind.rememberedTarget = fish::kNobody;
    } else if (!fish::interrupts(mind.intention, mind.alarm) && fish::isResumed(mind.intention)) {
        mind.remembered = mind.intention;
        mind.rememberedTarget = mind.target;
        mind.sinceRemembered = 0;
    }
}

// A new aim: its clock and stage begin anew, and those of a chase and a charge where one begins or
// ends.
void restartClocks(fish::Mind& mind, fish::Intention before, fish::Intention after) {
    mind.pursued = 0;
    mind.stage = 0;
    mind.sinceStage = 0;
    const bool chased = before == fish::Intention::Eat;
    const bool chases = after == fish::Intention::Eat;
    if (chased != chases) mind.sinceChase = 0;
    const bool charged = before == fish::Intention::Charge;
    if (charged != (after == fish::Intention::Charge)) mind.sinceCharge = 0;
}

}  // namespace

void remember(fish::Mind& mind, const Decision& decision) {
    const fish::Aim before = fish::aimOf(mind);
    rememberInterrupted(mind, decision);
    mind.intention = decision.intention;
    mind.target = decision.target;
    mind.alarm = decision.alarm;
    const fish::Aim after = fish::aimOf(mind);
    // An interruption does not change the aim, so that clocks and stage go on.
    if (after != before) restartClocks(mind, before.intention, after.intention);
}

bool acceptsRecommendation(const fish::SpeciesParameters& parameters,
                           const fish::Mind& mind,
                           const Senses& senses,
                           const fish::Feelings& feelings) {
    if (senses.urgency > kCalm || feelings.fear > parameters.habits.fear.from) return false;
    switch (mind.intention) {
        case fish::Intention::Wander:
        case fish::Intention::Hover:
        case fish::Intention::Leave:
        case fish::Intention::School:
            return true;
        case fish::Intention::Eat:
            return isFarFromMeal(parameters, senses);
        case fish::Intention::Graze:
        case fish::Intention::Clean:
        case fish::Intention::Visit:
        case fish::Intention::Mate:
        case fish::Intention::Charge:
        case fish::Intention::Rest:
        case fish::Intention::Hide:
        case fish::Intention::Escape:
        case fish::Intention::AvoidFish:
        case fish::Intention::AvoidObstacle:
            break;
    }
    return false;
}

}  // namespace aquarama::behaviour
