// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/courtship.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "common/base/hash.h"
#include "common/place/place.h"
#include "master/behaviour/intention_generator.h"
#include "master/behaviour/routines.h"
#include "master/fish/fish_view.h"

namespace aquarama::behaviour {

namespace {

constexpr auto kSecond = static_cast<std::uint32_t>(kTicksPerSecond);
constexpr glm::vec3 kUp{0, 1, 0};

// Longest time in a stage, by CourtshipStage.
constexpr std::array<std::uint32_t, 6> kLongestSeconds{20, 12, 25, 30, 15, 20};
// Shortest times in a stage; a loop takes about 6 s.
constexpr std::uint32_t kLoopSeconds = 6;
constexpr std::uint32_t kCircleSeconds = 8;
constexpr std::uint32_t kAscentSeconds = 4;
constexpr std::uint32_t kNuzzleSeconds = 3;

// Distances in body lengths.
// Within this distance a pair is together.
constexpr float kTogether = 5.0F;
// The male loops about a point this far before her; they circle about the point between them.
constexpr float kLoopAhead = 2.6F;
constexpr float kLoopRadius = 1.5F;
// Farther than so many radii from its centre he comes to the loop first.
constexpr float kFarFromLoop = 2.0F;
constexpr float kCircleRadius = 1.4F;
// Weight of the way back to the circle, for each radius off it.
constexpr float kCloser = 0.8F;
// Distance that a follower keeps.
constexpr float kBehind = 1.0F;
// Depth below her at which he rises, and at which he nuzzles her belly: there bodies touch.
constexpr float kBelow = 0.7F;
constexpr float kBelly = 0.3F;
constexpr float kMateTouches = 0.6F;
// Within this distance of his place he keeps station instead of pursuing it.
constexpr float kStationFrom = 1.5F;
// Body lengths a second faster for each body length that he is behind.
constexpr float kMateCatchUp = 0.8F;
// Weight of a body length off his place, against her course.
constexpr float kClose = 0.7F;
// Her speed while he nuzzles her, as a share of the slow gait.
constexpr float kYielding = 0.9F;

// Sines of pitch angles.
constexpr float kRise = 0.42F;
constexpr float kBob = 0.2F;
constexpr std::uint32_t kBobTicks = 2 * kSecond;

// Pitch up and down in turn, a second each.
float bob(std::uint32_t ticks) {
    return ticks % kBobTicks < kBobTicks / 2 ? kBob : -kBob;
}

// The level unit vector of a direction.
glm::vec3 level(glm::vec3 direction) {
    return place::directionOf({direction.x, 0, direction.z}, {1, 0, 0});
}

// Direction along a level circle around a point; corrects the distance and the height.
glm::vec3 aroundOn(glm::vec3 toCentre, float radius, bool left) {
    const glm::vec3 inwards = level(toCentre);
    const glm::vec3 along =
        left ? glm::vec3{inwards.z, 0, -inwards.x} : glm::vec3{-inwards.z, 0, inwards.x};
    const float far = std::sqrt(toCentre.x * toCentre.x + toCentre.z * toCentre.z);
    const glm::vec3 closer = inwards * (kCloser * (far - radius) / radius);
    return along + closer + kUp * (0.5F * toCentre.y / radius);
}

// Movements of the stages. Where the sexes differ, he follows, loops or keeps below her; she
// hovers, bobs or rises.
fish::Course follow(const Situation& situation, const Couple& couple) {
    const glm::vec3 behind = couple.offset - couple.matesHeading * (kBehind * couple.length);
    return pursue(
        situation, behind, situation.parameters.medium, couple.matesHeading * couple.matesSpeed);
}

fish::Course loopBefore(const Situation& situation, const fish::Mind& mind, const Couple& couple) {
    const glm::vec3 centre =
        couple.offset + level(couple.matesHeading) * (kLoopAhead * couple.length);
    const float radius = kLoopRadius * couple.length;
    if (place::lengthOf(centre) > kFarFromLoop * radius)
        return heading(situation, centre, situation.parameters.medium);
    const glm::vec3 way = aroundOn(centre, radius, couple.turnsLeft);
    return heading(situation, way + kUp * bob(mind.sinceStage), situation.parameters.slow);
}

fish::Course hoverAndBob(const Situation& situation, const fish::Mind& mind) {
    return heading(situation, level(situation.senses.heading) + kUp * bob(mind.sinceStage), 0);
}

fish::Course circle(const Situation& situation, const Couple& couple) {
    const glm::vec3 way =
        aroundOn(couple.offset * 0.5F, kCircleRadius * couple.length, couple.turnsLeft);
    return heading(situation, way, situation.parameters.slow);
}

fish::Course rise(const Situation& situation) {
    const fish::SpeciesParameters& parameters = situation.parameters;
    return heading(situation,
                   level(situation.senses.heading) + kUp * kRise,
                   parameters.habits.spawnsInRush ? parameters.medium : parameters.slow);
}

// Keeps a place below her: pursues it from afar, matches her speed when near.
fish::Course keepBelow(const Situation& situation, const Couple& couple, float below) {
    const fish::SpeciesParameters& parameters = situation.parameters;
    const glm::vec3 place = couple.offset - kUp * (below * couple.length);
    if (place::lengthOf(place) > kStationFrom * couple.length)
        return pursue(situation, place, parameters.medium, couple.matesHeading * couple.matesSpeed);
    const glm::vec3 astray = place / couple.length;
    const float behind = place::dot(astray, couple.matesHeading);
    const float pace = couple.matesSpeed / situation.senses.length + kMateCatchUp * behind;
    return heading(
        situation,
        couple.matesHeading + astray * kClose,
        std::clamp(pace,
                   0.5F * parameters.slow,
                   parameters.habits.spawnsInRush ? parameters.fast : parameters.medium));
}

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

// Whether a male joins a female that spawns in a rush with another one.
bool joinsRush(const Situation& situation, const fish::Mind& mind, std::uint32_t courted) {
    const bool isMale = (mind.likes & fish::kIsFemale) == 0;
    return situation.parameters.habits.spawnsInRush && isMale && courted != fish::kNobody;
}

// Sets the stage by what the other fish does now. Of two fish that court each other the one that is
// behind catches up. In a rush a female rises as soon as a male follows her, and others join him.
void fallIn(const Situation& situation, fish::Mind& mind) {
    const fish::FishView& view = *situation.environment.view;
    const bool rushes = situation.parameters.habits.spawnsInRush;
    const std::uint32_t courted = view.partner[mind.target];
    if (courted != situation.fish && !joinsRush(situation, mind, courted))
        return enter(
            mind,
            courted == fish::kNobody || rushes ? CourtshipStage::Follow : CourtshipStage::Impress);
    const CourtshipStage theirs = stageOf(view.stage[mind.target]);
    const CourtshipStage first = rushes ? CourtshipStage::Ascend : CourtshipStage::Loop;
    enter(mind, std::max({stageOf(mind.stage), theirs, first}));
}

// Enters the next stage when this one is complete. After the last the male reports the spawning.
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

bool isComplete(CourtshipStage stage,
                const Couple& couple,
                glm::vec3 heading,
                std::uint32_t ticks) {
    assert(couple.length > 0);
    const float distance = place::lengthOf(couple.offset);
    const bool together = distance < kTogether * couple.length;
    const glm::vec3 fromHerToHim = couple.isFemale ? couple.offset : -couple.offset;
    const glm::vec3 herHeading = couple.isFemale ? heading : couple.matesHeading;
    switch (stage) {
        case CourtshipStage::Follow:
        case CourtshipStage::Impress:
            return false;
        case CourtshipStage::Loop:
            return together && ticks > kLoopSeconds * kSecond &&
                   place::dot(fromHerToHim, herHeading) > 0;
        case CourtshipStage::Circle:
            return together && ticks > kCircleSeconds * kSecond;
        case CourtshipStage::Ascend:
            return together && ticks > kAscentSeconds * kSecond && fromHerToHim.y < 0;
        case CourtshipStage::Nuzzle:
            break;
    }
    return distance < kMateTouches * couple.length && ticks > kNuzzleSeconds * kSecond &&
           fromHerToHim.y < 0;
}

std::uint32_t longestTicks(CourtshipStage stage) {
    assert(static_cast<std::size_t>(stage) < kLongestSeconds.size());
    return kLongestSeconds[static_cast<std::size_t>(stage)] * kSecond;
}

fish::Course court(const Situation& situation,
                   const fish::Mind& mind,
                   const Couple& couple,
                   CourtshipStage stage) {
    switch (stage) {
        case CourtshipStage::Follow:
            break;
        case CourtshipStage::Impress:
        case CourtshipStage::Loop:
            return couple.isFemale ? hoverAndBob(situation, mind)
                                   : loopBefore(situation, mind, couple);
        case CourtshipStage::Circle:
            return circle(situation, couple);
        case CourtshipStage::Ascend:
            return couple.isFemale ? rise(situation) : keepBelow(situation, couple, kBelow);
        case CourtshipStage::Nuzzle:
            return couple.isFemale ? heading(situation,
                                             level(situation.senses.heading),
                                             kYielding * situation.parameters.slow)
                                   : keepBelow(situation, couple, kBelly);
    }
    return follow(situation, couple);
}

fish::Course mate(const Situation& situation, fish::Mind& mind, DeferredEvents& events) {
    assert(mind.target < situation.environment.view->size());
    fallIn(situation, mind);
    const Couple couple = coupleOf(situation, mind);
    goOn(mind, couple, situation, events);
    const CourtshipStage stage = stageOf(mind.stage);
    if (mind.sinceStage > longestTicks(stage)) {
        // It gives up: its libido starts from 0, as after spawning.
        mind.sinceSpawning = 0;
        return wander(situation);
    }
    return court(situation, mind, couple, stage);
}

}  // namespace aquarama::behaviour
