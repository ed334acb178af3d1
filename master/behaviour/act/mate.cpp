// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "common/units/hash.h"
#include "master/behaviour/act/courtship.h"
#include "master/behaviour/act/routines.h"

namespace aquarama::behaviour {

namespace {

Couple coupleOf(const Situation& situation, const fish::Mind& mind) {
    const fish::FishView& view = *situation.environment.view;
    const std::uint32_t mate = mind.target;
    const std::uint32_t first = std::min(situation.fish, mate);
    return {.offset = view.position(mate) - situation.senses.position,
            .matesHeading = view.heading(mate),
            .matesSpeed = view.fish[mate].speed,
            .length = 0.5F * (situation.senses.length + view.fish[mate].length),
            .isFemale = (mind.likes & fish::kIsFemale) != 0,
            .turnsLeft = (hashOf(situation.environment.seed, first) & 1U) != 0};
}

CourtshipStage stageOf(std::uint8_t stage) {
    return static_cast<CourtshipStage>(stage);
}

void enter(fish::Mind& mind, CourtshipStage stage) {
    if (stageOf(mind.stage) == stage) return;
    mind.stage = static_cast<std::uint8_t>(stage);
    mind.sinceStage = 0;
}

// Where the other stands now puts a fish into its stage: of two that court each other the one that
// is behind catches up.
void fallIn(const Situation& situation, fish::Mind& mind) {
    const fish::FishView& view = *situation.environment.view;
    const std::uint32_t courted = view.partner[mind.target];
    if (courted != situation.fish)
        return enter(mind,
                     courted == fish::kNobody ? CourtshipStage::Follow : CourtshipStage::Impress);
    const CourtshipStage theirs = stageOf(view.stage[mind.target]);
    enter(mind, std::max({stageOf(mind.stage), theirs, CourtshipStage::Loop}));
}

void goOn(fish::Mind& mind,
          const Couple& couple,
          const Situation& situation,
          DeferredEvents& events) {
    const CourtshipStage stage = stageOf(mind.stage);
    if (!isComplete(stage, couple, situation.senses.heading, mind.sinceStage)) return;
    if (stage != CourtshipStage::Nuzzle) {
        enter(mind, static_cast<CourtshipStage>(mind.stage + 1));
    } else if (!couple.isFemale) {
        events.push_back({fish::DeferredEventKind::Spawn, situation.fish, mind.target});
    }
}

}  // namespace

fish::Course mate(const Situation& situation, fish::Mind& mind, DeferredEvents& events) {
    fallIn(situation, mind);
    const Couple couple = coupleOf(situation, mind);
    goOn(mind, couple, situation, events);
    const CourtshipStage stage = stageOf(mind.stage);
    if (mind.sinceStage > longestTicks(stage)) {
        mind.sinceSpawning = 0;  // its mood is gone, as after spawning
        return wander(situation);
    }
    return court(situation, mind, couple, stage);
}

}  // namespace aquarama::behaviour
