// SPDX-License-Identifier: Apache-2.0
#include "common/place/angle.h"
#include "master/behaviour/act/pursue.h"
#include "master/behaviour/act/routines.h"
#include "master/fish/mouth.h"

namespace aquarama::behaviour {

namespace {

// The cone of suction from the mouth, in body lengths. It is as long as a fish comes forward
// between two thoughts, so that it misses nothing that it swims through.
constexpr float kSuction = 0.3F;
constexpr float kSuctionCosine = 0.6F;  // half an angle of 53 degrees
constexpr float kAtTheLips = 0.08F;     // in every direction

// A particle that it has come too near to, without having it before the mouth, would be circled:
// the fish swims on and turns back for it from farther off.
enum Stage : std::uint8_t { kApproach, kRunUp };
constexpr float kTooNear = 2.0F;  // body lengths
constexpr float kRunUpLengths = 3.0F;
constexpr float kAbeamCosine = 0.35F;
constexpr std::uint32_t kRunUpTicks = 240;  // at most
constexpr float kSteepest = 0.42F;          // sine of the steepest way up or down

void enter(fish::Mind& mind, Stage stage) {
    mind.stage = stage;
    mind.sinceStage = 0;
}

bool cannotTurnTo(const Senses& senses, glm::vec3 fromMouth) {
    const float distance = place::lengthOf(fromMouth);
    if (distance > kTooNear * senses.length) return false;
    return place::dot(fromMouth, senses.heading) < kAbeamCosine * distance ||
           std::abs(fromMouth.y) > 2 * kSteepest * distance;
}

}  // namespace

bool isBeforeTheMouth(const Senses& senses, glm::vec3 offset) {
    const glm::vec3 fromMouth = offset - senses.heading * (fish::kMouthBodyLengths * senses.length);
    const float distance = place::lengthOf(fromMouth) / senses.length;
    return distance <= kAtTheLips ||
           (distance <= kSuction &&
            place::dot(fromMouth, senses.heading) >= kSuctionCosine * place::lengthOf(fromMouth));
}

fish::Course eat(const Situation& situation, fish::Mind& mind, DeferredEvents& events) {
    const Senses& senses = situation.senses;
    const Sighting& food = senses.food;
    const float slow = situation.parameters.slow;
    if (isBeforeTheMouth(senses, food.offset))
        events.push_back({fish::DeferredEventKind::EatParticle, situation.fish, food.object});
    const glm::vec3 fromMouth =
        food.offset - senses.heading * (fish::kMouthBodyLengths * senses.length);
    if (mind.stage == kApproach && cannotTurnTo(senses, fromMouth)) enter(mind, kRunUp);
    const bool farEnough = food.distance > kRunUpLengths * senses.length;
    if (mind.stage == kRunUp && (farEnough || mind.sinceStage > kRunUpTicks))
        enter(mind, kApproach);
    if (mind.stage == kRunUp)
        return heading(situation, {senses.heading.x, 0, senses.heading.z}, slow);
    return pursue(situation, fromMouth, situation.parameters.medium);
}

}  // namespace aquarama::behaviour
