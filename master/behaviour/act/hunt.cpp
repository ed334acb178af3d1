// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "common/place/angle.h"
#include "master/behaviour/act/pursue.h"
#include "master/behaviour/act/routines.h"
#include "master/fish/mouth.h"

namespace aquarama::behaviour {

namespace {

constexpr float kRushFrom = 2.0F;               // body lengths
constexpr float kAheadCosine = 0.5F;            // and only at what is before it
constexpr std::uint32_t kStalkTicks = 20 * 60;  // then the time of its chase runs
// A bite reaches so far from the mouth, in body lengths: a gape and the water that rushes in.
constexpr float kBite = 0.05F;
constexpr float kBiteCosine = 0.85F;  // or, before it, further by as much again
constexpr float kMostLeadSeconds = 0.3F;

bool isInTheMouth(const Senses& senses, glm::vec3 fromMouth) {
    const float distance = place::lengthOf(fromMouth) / senses.length;
    return distance <= kBite ||
           (distance <= 2 * kBite &&
            place::dot(fromMouth, senses.heading) >= kBiteCosine * place::lengthOf(fromMouth));
}

glm::vec3 velocityOf(const fish::FishView& view, std::uint32_t fish) {
    return view.heading(fish) * view.fish[fish].speed;
}

fish::Course stalk(const Situation& situation, fish::Mind& mind, const Sighting& prey) {
    const Senses& senses = situation.senses;
    const bool isBefore = place::dot(prey.offset, senses.heading) > kAheadCosine * prey.distance;
    if (isBefore && prey.distance < kRushFrom * senses.length) {
        mind.stage = static_cast<std::uint8_t>(HuntStage::Rush);
        mind.sinceStage = 0;
    }
    if (mind.sinceStage < kStalkTicks) mind.sinceChase = 0;
    return pursue(situation, prey.offset, situation.parameters.medium);
}

}  // namespace

fish::Course hunt(const Situation& situation, fish::Mind& mind, DeferredEvents& events) {
    const Senses& senses = situation.senses;
    const fish::FishView& view = *situation.environment.view;
    const Sighting& prey = senses.prey;
    const glm::vec3 fromMouth =
        prey.offset - senses.heading * (fish::kMouthBodyLengths * senses.length);
    if (isInTheMouth(senses, fromMouth))
        events.push_back({fish::DeferredEventKind::EatFish, situation.fish, prey.object});
    if (mind.stage == static_cast<std::uint8_t>(HuntStage::Stalk))
        return stalk(situation, mind, prey);
    const float speed = situation.parameters.fast;
    const float seconds =
        std::min(kMostLeadSeconds, place::lengthOf(fromMouth) / (speed * senses.length));
    return heading(situation, fromMouth + velocityOf(view, prey.object) * seconds, speed);
}

}  // namespace aquarama::behaviour
