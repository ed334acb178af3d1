// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cassert>
#include <optional>

#include "common/place/place.h"
#include "master/behaviour/intention_generator.h"
#include "master/behaviour/routines.h"
#include "master/fish/fish_view.h"
#include "master/surroundings/avoidance.h"

namespace aquarama::behaviour {

namespace {

// Distances in body lengths within which pursuit is careful: a fish slows down and steers to the
// exact place within the first, and steers so already within the second (paper, section 5.2).
constexpr float kCarefulWithin = 2.5F;
constexpr float kEarlierWithin = 5.0F;
// Cosine of 20 degrees: from far off this is near enough to the direction.
constexpr float kGeneralCosine = 0.94F;
// A nearer target to the side would only be circled: the fish slows and turns first.
constexpr float kTurnsWithin = 1.5F;
constexpr float kAbeamCosine = 0.5F;
// Shares of the slow gait: while turning towards a target, and at the target.
constexpr float kTurningPace = 0.6F;
constexpr float kCarefulPace = 1.2F;
// The motion of a target is extrapolated no farther than this.
constexpr float kMostLeadSeconds = 1.5F;

// Offset to where the target will be when the fish can be there.
glm::vec3 lead(const Situation& situation, glm::vec3 towards, float speed, glm::vec3 velocity) {
    const float metresPerSecond = std::max(0.05F, speed * situation.senses.length);
    return towards +
           velocity * std::min(kMostLeadSeconds, place::lengthOf(towards) / metresPerSecond);
}

// Sine of 58 degrees, nearly as steep as the motor goes.
constexpr float kSteepestDive = 0.85F;

// Weight of going aside against straight away, for a fish right before the predator.
constexpr float kAsideOfItsWay = 1.2F;
// Square metres: a predator nearer than 0.1 m does not count more.
constexpr float kNearestSquaredMetres = 0.01F;

// Direction away from one predator; `course` is its heading.
glm::vec3 awayFrom(glm::vec3 offset, glm::vec3 course, glm::vec3 otherwise) {
    const glm::vec3 away = place::directionOf(-offset, otherwise);
    const float before = place::dot(away, course);
    if (before <= 0) return place::directionOf(away, otherwise);
    const glm::vec3 aside = place::directionOf(away - course * before, otherwise);
    return place::directionOf(away + aside * (kAsideOfItsWay * before), otherwise);
}

// Cone of suction before the mouth, in body lengths. It is as long as the way of a fish between two
// thoughts, so that no particle in its path is missed.
constexpr float kSuction = 0.3F;
// Cosine of half the opening angle, 53 degrees.
constexpr float kSuctionCosine = 0.6F;
// Within this distance direction does not matter.
constexpr float kAtTheLips = 0.08F;

// Stages of eat(). A particle that is near but not before the mouth would only be circled: the fish
// swims on and turns back from farther off (kRunUp).
enum Stage : std::uint8_t { kApproach, kRunUp };
constexpr float kTooNear = 2.0F;  // body lengths
constexpr float kFoodRunUpLengths = 3.0F;
constexpr float kAsideCosine = 0.35F;
// Longest run-up.
constexpr std::uint32_t kFoodRunUpTicks = 240;

void enter(fish::Mind& mind, Stage stage) {
    mind.stage = stage;
    mind.sinceStage = 0;
}

// Whether a near particle is too far to the side, up or down to be reached by a turn.
bool cannotTurnTo(const Senses& senses, glm::vec3 fromMouth) {
    const float distance = place::lengthOf(fromMouth);
    if (distance > kTooNear * senses.length) return false;
    return place::dot(fromMouth, senses.heading) < kAsideCosine * distance ||
           std::abs(fromMouth.y) > 2 * place::kSteepest * distance;
}

// A predator rushes from this distance, in body lengths, once it aims at its prey: within 20
// degrees of ahead (Webb & Skadsen 1980). One that first has to turn is too slow.
constexpr float kRushFrom = 2.0F;
constexpr float kAimedCosine = 0.94F;
// Cosine of 37 degrees: one that hunts from ambush strikes at prey that is so far ahead.
constexpr float kStrikeCosine = 0.8F;
// A rush begins with a fast start, where the prey is to the side and nothing else is as near ahead
// or that way; from ambush where nothing is within so many body lengths.
constexpr std::uint32_t kStrikeTicks = 16;
constexpr float kAmbushLengths = 4.0F;
// Stalking for longer counts as part of the chase, whose time is limited.
constexpr std::uint32_t kStalkTicks = 20 * 60;
// Reach of a bite from the mouth, in body lengths, by its gape and suction; twice as far straight
// ahead.
constexpr float kBite = 0.08F;
constexpr float kBiteCosine = 0.85F;
constexpr float kMostHuntLeadSeconds = 0.3F;

bool isInTheMouth(const Senses& senses, glm::vec3 fromMouth) {
    const float distance = place::lengthOf(fromMouth) / senses.length;
    return distance <= kBite ||
           (distance <= 2 * kBite &&
            place::dot(fromMouth, senses.heading) >= kBiteCosine * place::lengthOf(fromMouth));
}

glm::vec3 velocityOf(const fish::FishView& view, std::uint32_t fish) {
    return view.heading(fish) * view.fish[fish].speed;
}

// One that hunts from ambush creeps up to its prey by a stroke now and then, in ticks: some 0.1
// m/s.
constexpr std::uint64_t kCreepTicks = 60;
constexpr std::uint64_t kStrokeTicks = 24;

// A stroke towards the prey, as steep as may be, or a rest.
fish::Course creep(const Situation& situation, glm::vec3 fromMouth) {
    const std::uint64_t now = situation.environment.tick.value + situation.fish;
    return {steeply(place::directionOf(fromMouth, situation.senses.heading)),
            now % kCreepTicks < kStrokeTicks ? situation.parameters.slow : 0.0F,
            0};
}

// Approaches at medium speed, or from ambush; changes to a rush when near.
fish::Course stalk(const Situation& situation,
                   fish::Mind& mind,
                   const Sighting& prey,
                   glm::vec3 fromMouth) {
    const Senses& senses = situation.senses;
    const std::optional<config::Ambush>& ambush = situation.parameters.habits.hunt.ambush;
    const bool isNear = ambush
                            ? place::lengthOf(fromMouth) < static_cast<float>(ambush->strikesMetres)
                            : prey.distance < kRushFrom * senses.length;
    const float cosine = ambush ? kStrikeCosine : kAimedCosine;
    if (isNear && place::dot(prey.offset, senses.heading) > cosine * prey.distance) {
        mind.stage = static_cast<std::uint8_t>(HuntStage::Rush);
        mind.sinceStage = 0;
    }
    if (mind.sinceStage < kStalkTicks) mind.sinceChase = 0;
    return ambush ? creep(situation, fromMouth)
                  : pursue(situation, prey.offset, situation.parameters.medium);
}

}  // namespace

fish::Course pursue(const Situation& situation,
                    glm::vec3 towards,
                    float speed,
                    glm::vec3 velocity) {
    assert(speed >= 0);
    const Senses& senses = situation.senses;
    const float slow = situation.parameters.slow;
    const glm::vec3 to = lead(situation, towards, speed, velocity);
    const glm::vec3 direction = place::directionOf(to, senses.heading);
    const float lengths = place::lengthOf(to) / senses.length;
    const float along = place::dot(direction, senses.heading);
    const float careful =
        situation.environment.adaptation.earlierPursuit ? kEarlierWithin : kCarefulWithin;
    if (lengths >= careful)
        return heading(situation, along > kGeneralCosine ? senses.heading : direction, speed);
    if (lengths < kTurnsWithin && along < kAbeamCosine)
        return heading(situation, direction, kTurningPace * slow);
    const float least = std::min(speed, kCarefulPace * slow);
    // A target that swims away adds its own speed.
    const float chase = std::max(0.0F, place::dot(velocity, direction)) / senses.length;
    const float pace = least + (speed - least) * std::min(1.0F, lengths / kCarefulWithin);
    return heading(situation, direction, std::min(speed, pace + chase));
}

fish::Course heading(const Situation& situation, glm::vec3 desired, float speed) {
    const Senses& senses = situation.senses;
    const glm::vec3 direction =
        place::levelled(place::directionOf(desired + wayRound(situation), senses.heading));
    return {direction, speed, senses.urgency};
}

glm::vec3 steeply(glm::vec3 direction) {
    const float y = std::clamp(direction.y, -kSteepestDive, kSteepestDive);
    const float level = std::sqrt(direction.x * direction.x + direction.z * direction.z);
    if (level < 1.0e-4F) return {std::sqrt(1 - y * y), y, 0};
    const float scale = std::sqrt(1 - y * y) / level;
    return {direction.x * scale, y, direction.z * scale};
}

glm::vec3 flightFrom(const Situation& situation) {
    const fish::FishView& view = *situation.environment.view;
    const Senses& senses = situation.senses;
    const glm::vec3 side = place::directionOf({-senses.heading.z, 0, senses.heading.x}, {0, 0, 1});
    glm::vec3 flight{};
    const auto flee = [&](const Sighting& from) {
        const float squared = std::max(from.distance * from.distance, kNearestSquaredMetres);
        flight += awayFrom(from.offset, view.heading(from.object), side) / squared;
    };
    for (std::size_t i = 0; i < senses.predatorCount; ++i) flee(senses.predators[i]);
    if (senses.territory.charger.seen()) flee(senses.territory.charger);
    return place::directionOf(flight, {});
}

bool isBeforeTheMouth(const Senses& senses, glm::vec3 offset) {
    const glm::vec3 fromMouth = offset - senses.heading * (fish::kNoseBodyLengths * senses.length);
    const float distance = place::lengthOf(fromMouth) / senses.length;
    return distance <= kAtTheLips ||
           (distance <= kSuction &&
            place::dot(fromMouth, senses.heading) >= kSuctionCosine * place::lengthOf(fromMouth));
}

fish::Course eat(const Situation& situation, fish::Mind& mind, DeferredEvents& events) {
    assert(situation.senses.food.seen());
    const Senses& senses = situation.senses;
    const Sighting& food = senses.food;
    const float medium = situation.parameters.medium;
    if (isBeforeTheMouth(senses, food.offset))
        events.push_back({fish::DeferredEventKind::EatParticle, situation.fish, food.object});
    const glm::vec3 fromMouth =
        food.offset - senses.heading * (fish::kNoseBodyLengths * senses.length);
    if (mind.stage == kApproach && cannotTurnTo(senses, fromMouth)) enter(mind, kRunUp);
    const bool farEnough = food.distance > kFoodRunUpLengths * senses.length;
    if (mind.stage == kRunUp && (farEnough || mind.sinceStage > kFoodRunUpTicks))
        enter(mind, kApproach);
    if (mind.stage == kRunUp)
        return heading(situation, {senses.heading.x, 0, senses.heading.z}, medium);
    return pursue(situation, fromMouth, medium);
}

bool hasRoom(const Situation& situation,
             glm::vec3 direction,
             float lengths,
             const surroundings::Berth& berth) {
    const auto isFree = [&](glm::vec3 way) {
        return surroundings::avoidance(situation.environment.surroundings->obstacles,
                                       situation.senses.position,
                                       way,
                                       lengths * situation.senses.length,
                                       berth) == glm::vec3{};
    };
    return isFree(direction) && isFree(situation.senses.heading);
}

bool isRushing(const fish::Mind& mind) {
    return mind.intention == fish::Intention::Eat &&
           mind.stage == static_cast<std::uint8_t>(HuntStage::Rush);
}

fish::Course hunt(const Situation& situation, fish::Mind& mind, DeferredEvents& events) {
    assert(situation.senses.prey.seen());
    const Senses& senses = situation.senses;
    const fish::FishView& view = *situation.environment.view;
    const Sighting& prey = senses.prey;
    const glm::vec3 fromMouth =
        prey.offset - senses.heading * (fish::kNoseBodyLengths * senses.length);
    if (isInTheMouth(senses, fromMouth))
        events.push_back({fish::DeferredEventKind::EatFish, situation.fish, prey.object});
    if (mind.stage == static_cast<std::uint8_t>(HuntStage::Stalk))
        return stalk(situation, mind, prey, fromMouth);
    const float speed = situation.parameters.fast;
    // Aims at where the prey will be, but not far ahead: prey that turns gets away.
    const float seconds =
        std::min(kMostHuntLeadSeconds, place::lengthOf(fromMouth) / (speed * senses.length));
    fish::Course course =
        heading(situation, fromMouth + velocityOf(view, prey.object) * seconds, speed);
    const bool ambush = situation.parameters.habits.hunt.ambush.has_value();
    if (ambush && senses.urgency < 1)
        course.direction = steeply(place::directionOf(
            fromMouth + velocityOf(view, prey.object) * seconds, senses.heading));
    const float room = ambush ? kAmbushLengths : prey.distance / senses.length;
    course.startsFast =
        mind.sinceStage < kStrikeTicks &&
        hasRoom(situation, course.direction, room, surroundings::berthOf(senses.length));
    return course;
}

}  // namespace aquarama::behaviour
