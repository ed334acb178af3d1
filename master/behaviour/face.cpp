// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/face.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "common/motion/gaze.h"
#include "common/place/place.h"
#include "master/behaviour/curiosity.h"

namespace aquarama::behaviour {

namespace {

// Levels of an open mouth, in 1/255.
constexpr std::uint8_t kSnap = 255;      // at a particle or at prey
constexpr std::uint8_t kTurfBite = 170;  // of turf
constexpr std::uint8_t kRush = 90;       // at prey that is not near yet
constexpr std::uint8_t kThreat = 150;    // at an intruder
constexpr std::uint8_t kPosing = 110;    // before a cleaner
constexpr std::uint8_t kCleaned = 200;   // with one
constexpr std::uint8_t kPicking = 80;    // of a cleaner at its client
// A predator that rushes opens its jaws at prey within so many of its lengths.
constexpr float kGapesWithin = 0.8F;
// A cleaner picks within so many of its lengths and so many metres of a client.
constexpr float kPicksWithin = 0.6F;
constexpr float kPicksMetres = 0.15F;
// A fish at ease looks at the submarine from so near, metres.
constexpr float kWatchesMetres = 2.5F;

std::uint8_t huntingMouth(const Situation& situation, const fish::Mind& mind) {
    if (situation.parameters.habits.role != config::Role::Predator || !isRushing(mind)) return 0;
    const bool isNear = situation.senses.prey.distance < kGapesWithin * situation.senses.length;
    return isNear ? kSnap : kRush;
}

std::uint8_t posingMouth(const Situation& situation, const fish::Mind& mind) {
    if (mind.stage != static_cast<std::uint8_t>(VisitStage::Pose)) return 0;
    return situation.senses.cleaning.cleaned ? kCleaned : kPosing;
}

std::uint8_t cleaningMouth(const Situation& situation) {
    const Sighting& client = situation.senses.cleaning.client;
    if (!client.seen()) return 0;
    const float theirs = situation.environment.view->fish[client.object].length;
    return client.distance < kPicksWithin * theirs + kPicksMetres ? kPicking : 0;
}

// Whether a thought has reported an event of this kind.
bool reports(std::span<const fish::DeferredEvent> own, fish::DeferredEventKind kind) {
    return std::ranges::find(own, kind, &fish::DeferredEvent::kind) != own.end();
}

std::uint8_t mouthOf(const Situation& situation,
                     const fish::Mind& mind,
                     std::span<const fish::DeferredEvent> own) {
    if (reports(own, fish::DeferredEventKind::EatParticle) ||
        reports(own, fish::DeferredEventKind::EatFish))
        return kSnap;
    switch (mind.intention) {
        case fish::Intention::Eat:
            return huntingMouth(situation, mind);
        case fish::Intention::Graze:
            return reports(own, fish::DeferredEventKind::Bite) ? kTurfBite : std::uint8_t{0};
        case fish::Intention::Charge:
            return kThreat;
        case fish::Intention::Visit:
            return posingMouth(situation, mind);
        case fish::Intention::Clean:
            return cleaningMouth(situation);
        default:
            return 0;
    }
}

// What a fish attends to by its intention.
const Sighting* targetOf(const Situation& situation, const fish::Mind& mind) {
    const Senses& senses = situation.senses;
    switch (mind.intention) {
        case fish::Intention::Eat:
            return situation.parameters.habits.role == config::Role::Predator ? &senses.prey
                                                                              : &senses.food;
        case fish::Intention::Mate:
            return &senses.mate;
        case fish::Intention::Charge:
            return &senses.territory.intruder;
        case fish::Intention::Visit:
            return &senses.cleaning.cleaner;
        case fish::Intention::Clean:
            return &senses.cleaning.client;
        case fish::Intention::AvoidFish:
            return &senses.collision;
        default:
            return senses.predatorCount > 0 ? &senses.predators.front() : nullptr;
    }
}

// Offset of what it looks at, metres, world axes; zero where that is nothing.
glm::vec3 attended(const Situation& situation, const fish::Mind& mind) {
    const Sighting* const target = targetOf(situation, mind);
    if (target != nullptr && target->seen()) return target->offset;
    const glm::vec3 position = situation.senses.position;
    const auto& hands = situation.environment.surroundings->hands;
    if (target == nullptr && !hands.hands.empty()) return nearestHand(hands, position) - position;
    if (target == nullptr && situation.senses.submarineMetres < kWatchesMetres)
        return situation.environment.surroundings->submarine.position - situation.senses.position;
    return {};
}

// In the body frame of a fish that does not roll.
glm::vec3 fromBody(glm::vec3 heading, glm::vec3 offset) {
    const glm::vec3 right = place::directionOf({-heading.z, 0, heading.x}, {0, 0, 1});
    const glm::vec3 up = glm::cross(right, heading);
    return {place::dot(offset, heading), place::dot(offset, up), place::dot(offset, right)};
}

}  // namespace

fish::Face faceOf(const Situation& situation,
                  const fish::Mind& mind,
                  std::span<const fish::DeferredEvent> own) {
    const glm::vec3 offset = attended(situation, mind);
    const bool looks = offset != glm::vec3{};
    return {.mouth = mouthOf(situation, mind, own),
            .gaze = looks ? motion::gazeTowards(fromBody(situation.senses.heading, offset))
                          : std::uint8_t{0}};
}

}  // namespace aquarama::behaviour
