// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/cleaning.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/base/random_streams.h"
#include "common/base/units.h"
#include "common/place/place.h"
#include "master/behaviour/company.h"
#include "master/behaviour/home.h"
#include "master/behaviour/intention_generator.h"
#include "master/behaviour/points_within.h"
#include "master/behaviour/routines.h"
#include "master/surroundings/avoidance.h"

namespace aquarama::behaviour {

namespace {

// A client wants a cleaner again after a time that it draws; a predator after so many times that.
constexpr float kShortestUrgeSeconds = 150;
constexpr float kUrgeSpreadSeconds = 150;
constexpr float kPredatorUrge = 5;
// It knows of stations so near, metres, and of the clients within so far of one.
constexpr float kKnownMetres = 8;
constexpr float kStationMetres = 1.5F;
// Where it waits too long it comes again after this share of its time has passed once more.
constexpr float kComesAgain = 0.75F;

// How far over the station a client poses: from it, and more by its length.
constexpr float kOverStation = 0.12F;
constexpr float kOverPerLength = 0.4F;
// A client is at the station within this distance, metres, and waits at this one and more.
constexpr float kAtStation = 0.9F;
constexpr float kWaitsAt = 0.6F;
constexpr float kWaitsPerLength = 0.4F;
// It gives up coming or waiting after this.
constexpr std::uint32_t kMostComingTicks = 40 * 60;
constexpr std::uint32_t kMostWaitingTicks = 35 * 60;
// How long it poses, drawn, longer while it is cleaned, and the sine of its tilt, drawn: 20 to 45
// degrees.
constexpr float kShortestPoseSeconds = 5;
constexpr float kPoseSpreadSeconds = 15;
constexpr float kLongestPoseSeconds = kShortestPoseSeconds + kPoseSpreadSeconds;
constexpr float kLeastTilt = 0.34F;
constexpr float kTiltSpread = 0.36F;

// A posing client is at its place within this, tilts within this, and tilts back where it is so
// far above or below it, metres.
constexpr float kPosesWithin = 0.15F;
constexpr float kTiltsWithin = 0.6F;
constexpr float kTurnsTilt = 0.2F;

// A cleaner pauses after a client for a time that it draws.
constexpr float kShortestPauseSeconds = 2;
constexpr float kPauseSpreadSeconds = 6;
// It inspects a client from this share of its longest inspection on.
constexpr float kShortestInspection = 1.0F / 3;
// One inspection in so many ends in a bite of skin.
constexpr std::uint32_t kBitesOneIn = 6;
// It is beside a client within this, of its length and in metres, and gives up after so long, in
// seconds beyond its longest inspection.
constexpr float kBesideLengths = 0.6F;
constexpr float kBesideClientMetres = 0.15F;
constexpr float kReachesWithin = 5;
// A bite is felt while it lasts; the chase that follows lasts so long.
constexpr std::uint32_t kBiteTicks = 16;
constexpr std::uint32_t kChaseTicks = 60;
// A cleaner picks so often, goes along the flank and back, and changes the flank, in ticks.
constexpr std::uint64_t kPickTicks = 20;
constexpr std::uint64_t kFlankTicks = std::uint64_t{5} * 60;
// From the middle line of a client, in its lengths: along it, and aside, and in lengths of the
// cleaner.
constexpr float kAlong = 0.32F;
constexpr float kAside = 0.11F;
constexpr float kAsideOwn = 0.4F;
// At a pick it comes nearer by so much of its length.
constexpr float kPickDepth = 0.25F;
constexpr float kInspectsWithin = 2;

// The dance of a cleaner that nobody visits: of every period a part, up and down.
constexpr std::uint64_t kDancePeriodTicks = std::uint64_t{9} * 60;
constexpr std::uint64_t kDanceTicks = std::uint64_t{3} * 60;
constexpr float kDanceHertz = 1.2F;
constexpr float kDanceSlope = 0.6F;
constexpr float kDanceMetres = 0.5F;

// A number of a fish for a stream and a time, in ticks.
std::uint32_t drawn(const Environment& environment,
                    Stream stream,
                    std::uint32_t fish,
                    std::uint64_t at) {
    return hashOf(hashOf(environment.seed, stream, fish), static_cast<std::uint32_t>(at));
}

// A cleaner as a client knows it: with the way to its station.
Sighting stationOf(const Environment& environment, std::uint32_t cleaner, glm::vec3 position) {
    const fish::SpeciesParameters& parameters =
        environment.speciesParameters[environment.view->kind[cleaner]];
    const glm::vec3 offset = homeOf(parameters, cleaner) - position;
    return {.object = cleaner, .offset = offset, .distance = place::lengthOf(offset)};
}

Sighting nearestStation(const Environment& environment, glm::vec3 position) {
    Sighting nearest;
    nearest.distance = std::min(kKnownMetres, environment.surroundings->clarityMetres);
    for (const fish::SpeciesParameters& parameters : environment.speciesParameters) {
        if (!parameters.habits.cleans) continue;
        for (std::uint32_t fish = parameters.first; fish < parameters.last;
             fish += parameters.fishAtAHome) {
            const Sighting station = stationOf(environment, fish, position);
            const bool away = environment.view->shows(fish, fish::kAway);
            if (!away && station.distance < nearest.distance) nearest = station;
        }
    }
    return nearest;
}

// Whether a cleaner of the household is with the fish, and whether one bites it.
void feelCleaners(const fish::FishView& view,
                  const fish::Household& household,
                  std::uint32_t fish,
                  CleaningSenses& cleaning) {
    for (std::uint32_t one = household.first; one < household.last; ++one) {
        if (view.partner[one] != fish) continue;
        cleaning.cleaned = true;
        cleaning.bitten = cleaning.bitten || view.stage[one] == std::uint8_t(CleanStage::Bite);
    }
}

void senseClients(const Environment& environment, std::uint32_t fish, Senses& senses) {
    const fish::FishView& view = *environment.view;
    const std::uint32_t cleaner = senses.cleaning.cleaner.object;
    const fish::Household household =
        fish::householdOf(environment.speciesParameters[view.kind[cleaner]], cleaner);
    const auto count = [&](std::uint32_t other, glm::vec3 /*offset*/, float /*squared*/) {
        if (other == fish || !household.holds(view.partner[other])) return;
        ++senses.cleaning.clients;
        senses.cleaning.posing +=
            view.stage[other] >= static_cast<std::uint8_t>(VisitStage::Pose) ? 1U : 0U;
    };
    visitPointsWithin(environment.grids->fish,
                      senses.position + senses.cleaning.cleaner.offset,
                      kStationMetres * kStationMetres,
                      count);
    feelCleaners(view, household, fish, senses.cleaning);
}

// Whether the cleaner is not done with a client, which is still there.
bool staysWith(const fish::FishView& view,
               const fish::Household& household,
               const fish::Mind& mind,
               std::uint32_t client) {
    const bool isDone = mind.sinceCleaning < mind.pursued;
    return !isDone && household.holds(view.partner[client]) && !view.shows(client, fish::kAway);
}

// The client that a cleaner is with, until it is done.
Sighting presentClient(const fish::FishView& view,
                       const fish::Household& household,
                       const fish::Mind& mind,
                       glm::vec3 position) {
    const fish::Aim aim = fish::aimOf(mind);
    if (aim.intention != fish::Intention::Clean || aim.target == fish::kNobody) return {};
    if (!staysWith(view, household, mind, aim.target)) return {};
    const Sighting present = sightingOf(view, aim.target, position);
    return present.distance < 2 * kStationMetres ? present : Sighting{};
}

// Whether a cleaner pauses after its last client.
bool pauses(const Environment& environment, std::uint32_t fish, const fish::Mind& mind) {
    const std::uint32_t pause =
        drawn(environment, Stream::Cleaning, fish, environment.tick.value - mind.sinceCleaning);
    return secondsOfTicks(mind.sinceCleaning) <
           kShortestPauseSeconds + kPauseSpreadSeconds * unitOf(pause);
}

// The client of a cleaner: the one that it is with until it is done; after a pause the nearest one
// that poses.
void senseClient(const Environment& environment,
                 const fish::SpeciesParameters& parameters,
                 std::uint32_t fish,
                 const fish::Mind& mind,
                 Senses& senses) {
    const fish::FishView& view = *environment.view;
    const fish::Household household = fish::householdOf(parameters, fish);
    senses.cleaning.client = presentClient(view, household, mind, senses.position);
    if (senses.cleaning.client.seen() || pauses(environment, fish, mind)) return;
    const auto consider = [&](std::uint32_t other, glm::vec3 /*offset*/, float /*squared*/) {
        if (!household.holds(view.partner[other]) ||
            view.stage[other] != static_cast<std::uint8_t>(VisitStage::Pose))
            return;
        const Sighting seen = sightingOf(view, other, senses.position);
        if (isNearer(seen, senses.cleaning.client)) senses.cleaning.client = seen;
    };
    visitPointsWithin(environment.grids->fish,
                      homeOf(parameters, fish),
                      kStationMetres * kStationMetres,
                      consider);
}

// The time after which a client wants a cleaner again.
float urgePeriodSeconds(const Environment& environment,
                        const fish::SpeciesParameters& parameters,
                        std::uint32_t fish) {
    return (kShortestUrgeSeconds +
            kUrgeSpreadSeconds * unitOf(drawn(environment, Stream::Urge, fish, 0))) *
           (parameters.habits.role == config::Role::Predator ? kPredatorUrge : 1.0F);
}

bool isVisiting(const fish::Mind& mind) {
    return fish::aimOf(mind).intention == fish::Intention::Visit;
}

// The cleaner that a client visits; else the nearest one, where its urge is strong enough.
Sighting cleanerFor(const Environment& environment, const fish::Mind& mind, const Senses& senses) {
    if (isVisiting(mind)) return stationOf(environment, fish::aimOf(mind).target, senses.position);
    return senses.cleaning.urge < 1 ? Sighting{} : nearestStation(environment, senses.position);
}

// Urge, cleaner and other clients of a fish that goes to cleaners.
void senseCleaner(const Environment& environment,
                  const fish::SpeciesParameters& parameters,
                  std::uint32_t fish,
                  const fish::Mind& mind,
                  Senses& senses) {
    senses.cleaning.urge =
        secondsOfTicks(mind.sinceCleaning) / urgePeriodSeconds(environment, parameters, fish);
    senses.cleaning.cleaner = cleanerFor(environment, mind, senses);
    if (!senses.cleaning.cleaner.seen()) return;
    senseClients(environment, fish, senses);
    if (!isVisiting(mind) && senses.cleaning.clients >= kMostClients) senses.cleaning.cleaner = {};
}

}  // namespace

bool goesToCleaners(const fish::SpeciesParameters& parameters, float lengthMetres) {
    return parameters.habits.role != config::Role::Prey && !parameters.habits.cleans &&
           lengthMetres > kLeastClientMetres;
}

void senseCleaning(const Environment& environment,
                   const fish::SpeciesParameters& parameters,
                   std::uint32_t fish,
                   const fish::Mind& mind,
                   Senses& senses) {
    if (parameters.habits.cleans)
        senseClient(environment, parameters, fish, mind, senses);
    else if (goesToCleaners(parameters, senses.length))
        senseCleaner(environment, parameters, fish, mind, senses);
}

namespace {

// Enters a stage of a routine.
template <class Stage>
void enter(fish::Mind& mind, Stage stage) {
    mind.stage = static_cast<std::uint8_t>(stage);
    mind.sinceStage = 0;
}

// From bow to stern of the client and back, -1 to 1.
float alongFlank(std::uint64_t ticks) {
    const auto part = static_cast<float>(ticks % kFlankTicks) / static_cast<float>(kFlankTicks);
    return part < 0.5F ? 4 * part - 1 : 3 - 4 * part;
}

// Goes along a flank and picks.
fish::Course inspect(const Situation& situation) {
    const Environment& environment = situation.environment;
    const Senses& senses = situation.senses;
    const fish::VisibleFish& client = environment.view->fish[senses.cleaning.client.object];
    const std::uint64_t now = environment.tick.value + situation.fish * 7;
    const std::uint32_t flank =
        drawn(environment, Stream::Cleaning, situation.fish, now / kFlankTicks);
    const std::uint32_t pick =
        drawn(environment, Stream::Cleaning, situation.fish, now / kPickTicks);
    const glm::vec3 side = place::directionOf({-client.heading.z, 0, client.heading.x}, {0, 0, 1}) *
                           ((flank & 1U) != 0 ? 1.0F : -1.0F);
    const float off = kAside * client.length + kAsideOwn * senses.length;
    const glm::vec3 spot = senses.cleaning.client.offset +
                           client.heading * (kAlong * client.length * alongFlank(now)) +
                           side * off + glm::vec3{0, 0.1F * client.length * signedUnitOf(pick), 0};
    // Every other part of a pick it darts at the skin.
    const bool picks = now % kPickTicks < kPickTicks / 2;
    const glm::vec3 goal = picks ? spot - side * (kPickDepth * senses.length) : spot;
    const float lengths = place::lengthOf(goal) / senses.length;
    if (lengths > kInspectsWithin)
        return pursue(situation, goal, situation.parameters.fast, client.heading * client.speed);
    const glm::vec3 course = goal - side * (0.6F * senses.length);
    return {steeply(place::directionOf(course, senses.heading)),
            std::min(situation.parameters.medium, situation.parameters.slow + 1.5F * lengths),
            0};
}

// Up and down over its station.
fish::Course dance(const Situation& situation, glm::vec3 towards) {
    const Senses& senses = situation.senses;
    const float part = static_cast<float>(situation.environment.tick.value % kDancePeriodTicks) /
                       static_cast<float>(kTicksPerSecond);
    const glm::vec3 level = place::directionOf(
        {senses.heading.x + towards.x, 0, senses.heading.z + towards.z}, {1, 0, 0});
    return {steeply(place::directionOf(
                level + glm::vec3{0, kDanceSlope * place::wave(part * kDanceHertz), 0}, level)),
            situation.parameters.slow,
            senses.urgency};
}

// About its home, now and then in its dance.
fish::Course awaitClients(const Situation& situation) {
    const glm::vec3 towards =
        homeOf(situation.parameters, situation.fish) - situation.senses.position;
    const std::uint64_t now = situation.environment.tick.value + situation.fish * 31;
    const bool dances =
        now % kDancePeriodTicks < kDanceTicks && place::lengthOf(towards) < kDanceMetres;
    return dances ? dance(situation, towards) : wander(situation);
}

// Ends an inspection that has lasted its time, in some cases with a bite.
void endInspection(const Situation& situation, fish::Mind& mind) {
    const Environment& environment = situation.environment;
    const Sighting& client = situation.senses.cleaning.client;
    const std::uint32_t visit =
        drawn(environment, Stream::Cleaning, situation.fish, environment.tick.value - mind.pursued);
    const auto longest = static_cast<float>(situation.parameters.habits.cleans->inspectSeconds);
    const float lasts =
        longest * (kShortestInspection + (1 - kShortestInspection) * unitOf(hashOf(visit, 1)));
    // The inspection begins where it is beside its client.
    const float length = environment.view->fish[client.object].length;
    const bool isThere = client.distance < kBesideLengths * length + kBesideClientMetres;
    if (!isThere) mind.sinceStage = 0;
    const bool isDone = secondsOfTicks(mind.sinceStage) > lasts ||
                        secondsOfTicks(mind.pursued) > longest + kReachesWithin;
    if (!isDone) return;
    if (visit % kBitesOneIn == 0)
        enter(mind, CleanStage::Bite);
    else
        mind.sinceCleaning = 0;
}

// Enters the next stage when this one is over; after the last one it is done with its client.
void goOn(const Situation& situation, fish::Mind& mind) {
    switch (static_cast<CleanStage>(mind.stage)) {
        case CleanStage::Inspect:
            endInspection(situation, mind);
            return;
        case CleanStage::Bite:
            if (mind.sinceStage > kBiteTicks) enter(mind, CleanStage::Flee);
            return;
        case CleanStage::Flee:
            if (mind.sinceStage > kChaseTicks) mind.sinceCleaning = 0;
            return;
    }
}

// Away from the client that it bit, and towards its home.
fish::Course fleeFromClient(const Situation& situation) {
    const Senses& senses = situation.senses;
    const glm::vec3 home = homeOf(situation.parameters, situation.fish) - senses.position;
    return heading(situation,
                   place::directionOf(-senses.cleaning.client.offset, senses.heading) + home * 0.5F,
                   situation.parameters.fast);
}

}  // namespace

fish::Course clean(const Situation& situation, fish::Mind& mind) {
    assert(situation.parameters.habits.cleans);
    if (!situation.senses.cleaning.client.seen()) return awaitClients(situation);
    goOn(situation, mind);
    return static_cast<CleanStage>(mind.stage) == CleanStage::Flee ? fleeFromClient(situation)
                                                                   : inspect(situation);
}

namespace {

// The fish leaves the cleaner, and wants one again when its time has passed.
void leaveCleaner(fish::Mind& mind) {
    mind.sinceCleaning = 0;
}

// Over its place at the station, tilted; a course against the current where that is strong.
fish::Course pose(const Situation& situation, glm::vec3 towards, std::uint32_t visit) {
    const float sine =
        (kLeastTilt + kTiltSpread * unitOf(hashOf(visit, 2))) * ((visit & 1U) != 0 ? 1.0F : -1.0F);
    const fish::Course course = keptPlace(situation, towards, kPosesWithin);
    if (place::lengthOf(towards) > kTiltsWithin) return course;
    // It swims only against the current; where that has moved it up or down, it tilts back.
    const float tilt = std::abs(towards.y) > kTurnsTilt ? std::copysign(sine, towards.y) : sine;
    const float level = std::sqrt(1 - tilt * tilt);
    const glm::vec3 along =
        place::directionOf({course.direction.x, 0, course.direction.z}, {1, 0, 0});
    return {{along.x * level, tilt, along.z * level}, course.speed, 0};
}

// On its way to its place at the station.
fish::Course comeToStation(const Situation& situation, fish::Mind& mind, glm::vec3 place) {
    const CleaningSenses& cleaning = situation.senses.cleaning;
    if (cleaning.clients >= kMostClients && cleaning.cleaner.distance < kStationMetres)
        leaveCleaner(mind);
    if (place::lengthOf(place) < kAtStation + kWaitsPerLength * situation.senses.length) {
        enter(mind, cleaning.posing == 0 ? VisitStage::Pose : VisitStage::Wait);
    } else if (mind.sinceStage > kMostComingTicks) {
        leaveCleaner(mind);
    }
    return pursue(situation, place, situation.parameters.medium);
}

// Beside the station, until nobody else poses there.
fish::Course waitForTurn(const Situation& situation, fish::Mind& mind, glm::vec3 place) {
    const Senses& senses = situation.senses;
    const glm::vec3 station = senses.cleaning.cleaner.offset;
    if (senses.cleaning.posing == 0) enter(mind, VisitStage::Pose);
    if (mind.sinceStage > kMostWaitingTicks) leaveCleaner(mind);
    const glm::vec3 out = place::directionOf({-station.x, 0, -station.z}, senses.heading);
    return keptPlace(
        situation,
        place + out * (kWaitsAt + kWaitsPerLength * senses.length) + roomFrom(situation) * 0.3F,
        0.25F);
}

// Poses for its time, longer while it is cleaned, unless it is bitten.
fish::Course poseUntilDone(const Situation& situation, fish::Mind& mind, glm::vec3 place) {
    const CleaningSenses& cleaning = situation.senses.cleaning;
    const std::uint32_t drawnNow = drawn(situation.environment,
                                         Stream::Pose,
                                         situation.fish,
                                         situation.environment.tick.value - mind.pursued);
    const float lasts = kShortestPoseSeconds + kPoseSpreadSeconds * unitOf(drawnNow);
    if (cleaning.bitten) enter(mind, VisitStage::Chase);
    const float posed = secondsOfTicks(mind.sinceStage);
    if (posed > kLongestPoseSeconds || (posed > lasts && !cleaning.cleaned)) leaveCleaner(mind);
    return pose(situation, place, drawnNow);
}

// After the cleaner that bit it.
fish::Course chaseCleaner(const Situation& situation, fish::Mind& mind) {
    const Senses& senses = situation.senses;
    if (mind.sinceStage > kChaseTicks) leaveCleaner(mind);
    const glm::vec3 cleaner =
        situation.environment.view->position(senses.cleaning.cleaner.object) - senses.position;
    fish::Course course = heading(situation, cleaner, situation.parameters.fast);
    course.startsFast =
        mind.sinceStage < kBiteTicks &&
        hasRoom(situation, course.direction, 2, surroundings::berthOf(senses.length));
    return course;
}

}  // namespace

fish::Course visit(const Situation& situation, fish::Mind& mind) {
    const Senses& senses = situation.senses;
    assert(senses.cleaning.cleaner.seen());
    const glm::vec3 place = senses.cleaning.cleaner.offset +
                            glm::vec3{0, kOverStation + kOverPerLength * senses.length, 0};
    switch (static_cast<VisitStage>(mind.stage)) {
        case VisitStage::Come:
            return comeToStation(situation, mind, place);
        case VisitStage::Wait:
            return waitForTurn(situation, mind, place);
        case VisitStage::Pose:
            return poseUntilDone(situation, mind, place);
        case VisitStage::Chase:
            break;
    }
    return chaseCleaner(situation, mind);
}

}  // namespace aquarama::behaviour
