// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/perceive.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

#include "common/place/obstacles.h"
#include "common/place/place.h"
#include "master/behaviour/cleaning.h"
#include "master/behaviour/feel_climate.h"
#include "master/behaviour/feel_surroundings.h"
#include "master/behaviour/hours.h"
#include "master/behaviour/onlooker.h"
#include "master/behaviour/patches.h"
#include "master/behaviour/points_within.h"
#include "master/behaviour/routines.h"
#include "master/behaviour/shelter.h"
#include "master/behaviour/territory.h"
#include "master/behaviour/vision.h"
#include "master/behaviour/ways.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"

namespace aquarama::behaviour {

namespace {

// b1 and b2 of the cost of a prey: schooling and turning make it costlier (Tu & Terzopoulos 1994).
constexpr float kSchoolingCost = 0.5F;
constexpr float kTurningCost = 0.2F;

// A reach of at most this many cells is searched as a whole by vectors; a longer one from the fish
// outwards, which can stop early.
constexpr float kNearCells = 1.5F;

// Finds the point of least cost in a grid. costOf(index, offset, distance) must be `distance` or
// more, so that a cost found limits the reach of the rest of the search; infinite for what is not
// wanted. Points beyond `reach` and those that cost more than `best` are left out. Of equal costs
// the lower index wins.
template <class CostOf>
Sighting cheapestIn(
    const SpatialGrid& grid, glm::vec3 position, float reach, float best, const CostOf& costOf) {
    Sighting cheapest;
    float reachSquared = std::min(reach * reach, best * best);
    if (reachSquared <= 0) return cheapest;
    const auto weigh = [&](std::uint32_t index, glm::vec3 offset, float squared) {
        if (squared > reachSquared) return;
        const float distance = std::sqrt(squared);
        const float cost = costOf(index, offset, distance);
        if (cost > best || (cost == best && index >= cheapest.object)) return;
        cheapest = {index, offset, distance};
        best = cost;
        reachSquared = std::min(reachSquared, cost * cost);
    };
    const float near = kNearCells * grid.cellMetres();
    if (reachSquared <= near * near) {
        visitPointsWithin(grid, position, reachSquared, weigh);
        return cheapest;
    }
    grid.visitAround(position, reachSquared, [&](const SpatialGrid::Candidates& row) {
        for (std::size_t i = 0; i < row.index.size(); ++i) {
            const glm::vec3 offset = glm::vec3{row.x[i], row.y[i], row.z[i]} - position;
            weigh(row.index[i], offset, place::dot(offset, offset));
        }
    });
    return cheapest;
}

// Cost of what is not wanted.
constexpr float kNever = std::numeric_limits<float>::infinity();

void feelItself(const fish::FishView& view, std::uint32_t fish, Senses& senses) {
    senses.position = view.position(fish);
    senses.heading = view.heading(fish);
    senses.speed = view.fish[fish].speed;
    senses.length = view.fish[fish].length;
}

void seeNeighbours(const Onlooker& onlooker) {
    const NearestFish nearest = nearestVisible(
        onlooker.view(), *onlooker.environment.grids, onlooker.parameters, onlooker.fish);
    onlooker.senses.schoolmates = nearest.schoolmates;
    onlooker.senses.others = nearest.others;
    // They are read last in the thought; until then they have come from memory.
    for (const Neighbours* those : {&onlooker.senses.schoolmates, &onlooker.senses.others})
        for (std::size_t i = 0; i < those->count; ++i) onlooker.view().fetch(those->fish[i]);
}

// The share of their danger that is heeded of a predator that lies in wait, and of one that is with
// a cleaner.
constexpr float kHeededInWait = 0.3F;
constexpr float kHeededAtCleaner = 0.3F;

// Cosine of 60 degrees: a predator whose course is farther off passes by.
constexpr float kTowardsCosine = 0.5F;

// Inserts a predator in order of distance if it is among the nearest; ties go to the lower index.
void insert(Senses& senses, const Sighting& predator) {
    const auto isNearerThan = [&](std::size_t place) {
        return isNearer(predator, senses.predators[place]);
    };
    if (senses.predatorCount == kMostPredators && !isNearerThan(kMostPredators - 1)) return;
    if (senses.predatorCount < kMostPredators) ++senses.predatorCount;
    std::size_t place = senses.predatorCount - 1;
    for (; place > 0 && isNearerThan(place - 1); --place)
        senses.predators[place] = senses.predators[place - 1];
    senses.predators[place] = predator;
}

// Removes predators that rock, sand or a nearer predator hides.
void forgetHiddenPredators(const Onlooker& onlooker) {
    Senses& senses = onlooker.senses;
    const std::array<Sighting, kMostPredators> looked = senses.predators;
    const std::size_t count = senses.predatorCount;
    const place::Obstacles& obstacles = onlooker.environment.surroundings->obstacles;
    senses.predatorCount = 0;
    senses.predators = {};
    for (std::size_t i = 0; i < count; ++i) {
        const SightLine ray{senses.position, looked[i].offset};
        bool hidden = terrainHides(obstacles, ray);
        for (std::size_t nearer = 0; nearer < i; ++nearer)
            hidden = hidden || bodyHides(onlooker.view(), looked[nearer].object, ray);
        if (!hidden) senses.predators[senses.predatorCount++] = looked[i];
    }
}

// The nearest visible predators. An alarmed fish looks around: it does not lose a predator in its
// blind angle.
void seePredators(const Onlooker& onlooker) {
    const fish::SpeciesParameters& parameters = onlooker.parameters;
    if (parameters.huntedBy == 0) return;
    Senses& senses = onlooker.senses;
    const fish::FishView& view = onlooker.view();
    const bool alarmed = onlooker.mind.alarm != fish::Alarm::Calm;
    const float reach = onlooker.sight(kMostConspicuous);
    float reachSquared = reach * reach;
    const auto notice = [&](std::uint32_t other, glm::vec3 offset, float squared) {
        if (squared > reachSquared || (parameters.huntedBy >> view.kind[other] & 1U) == 0) return;
        if (!alarmed && !inFieldOfView(senses.heading, offset)) return;
        const float seen = onlooker.sight(conspicuousness(view.fish[other].length));
        if (squared > seen * seen) return;
        const bool hunts = view.shows(other, fish::kHunting);
        const bool rushes =
            hunts && view.stage[other] == static_cast<std::uint8_t>(HuntStage::Rush);
        const float distance = std::sqrt(squared);
        const bool passesBy = place::dot(view.heading(other), offset) > -kTowardsCosine * distance;
        const fish::SpeciesParameters& hunter =
            onlooker.environment.speciesParameters[view.kind[other]];
        const bool waits = hunter.habits.hunt.ambush && !rushes;
        const bool isCleaned = view.partner[other] != fish::kNobody;
        insert(senses,
               {.object = other,
                .offset = offset,
                .distance = distance,
                .hunting = hunts && !waits,
                .rushing = rushes,
                .heeded = (waits ? kHeededInWait : 1) * (isCleaned ? kHeededAtCleaner : 1),
                .length = view.fish[other].length,
                .passesBy = passesBy});
        const float farthest = senses.predators[kMostPredators - 1].distance;
        if (senses.predatorCount == kMostPredators)
            reachSquared = std::min(reachSquared, farthest * farthest);
    };
    visitPointsWithin(onlooker.environment.grids->predators, senses.position, reachSquared, notice);
    forgetHiddenPredators(onlooker);
}

// A predator that is hungry enough to begin or continue a hunt.
bool mayHunt(const Onlooker& onlooker) {
    if (onlooker.parameters.habits.role != config::Role::Predator || onlooker.parameters.hunts == 0)
        return false;
    return fish::innerHunger(onlooker.parameters, onlooker.mind) >
           fish::kDesire * fish::kHysteresis;
}

// Cosine of 60 degrees: prey that is farther aside does not come before one that lies in wait.
constexpr float kBeforeCosine = 0.5F;

// Cost of a prey (Tu & Terzopoulos 1994): C_k = d_k (1 + b1 S_k + b2 E_k / pi); S_k: it schools,
// E_k: angle to it.
float costOfPrey(const Onlooker& onlooker, std::uint32_t other, glm::vec3 offset, float distance) {
    const fish::FishView& view = onlooker.view();
    if ((onlooker.parameters.hunts >> view.kind[other] & 1U) == 0 || view.shows(other, fish::kAway))
        return kNever;
    const glm::vec3 heading = onlooker.senses.heading;
    if (!inFieldOfView(heading, offset)) return kNever;
    const float ahead = place::dot(heading, offset);
    const float aside = std::sqrt(std::max(0.0F, distance * distance - ahead * ahead));
    const float schooling = view.shows(other, fish::kSchooling) ? kSchoolingCost : 0.0F;
    return distance * (1 + schooling + kTurningCost * place::angleOf(aside, ahead) / place::kPi);
}

// Focus of attention: the present target is kept while it is visible and no other is better by the
// fish's persistence. Rays for what hides an object are costly, so they are cast only to these two.
template <class CostOf>
Sighting attend(const Onlooker& onlooker,
                const SpatialGrid& grid,
                fish::Intention intention,
                float sight,
                const CostOf& costOf) {
    Sighting kept;
    float best = sight;
    if (onlooker.aim.intention == intention && onlooker.aim.target < onlooker.view().size()) {
        const Sighting present = onlooker.sightingOf(onlooker.aim.target);
        const float cost = costOf(present.object, present.offset, present.distance);
        if (present.distance <= sight && cost < kNever && !onlooker.isHidden(present)) {
            kept = present;
            best = std::min(best, cost * (1 - onlooker.parameters.habits.persistence));
        }
    }
    const Sighting other = cheapestIn(grid, onlooker.senses.position, sight, best, costOf);
    const bool better = other.seen() && other.object != kept.object && !onlooker.isHidden(other);
    return better ? other : kept;
}

// The prey of least cost. Prey so far away that a chase would be given up is not considered.
void seePrey(const Onlooker& onlooker) {
    if (!mayHunt(onlooker)) return;
    onlooker.senses.huntersActive = surroundings::huntersActive(*onlooker.environment.surroundings);
    const config::Hunt& hunt = onlooker.parameters.habits.hunt;
    // One that lies in wait heeds what is near and ahead; it keeps what it is after.
    const bool waits = hunt.ambush && onlooker.aim.intention != fish::Intention::Eat;
    const float leastCosine = waits ? kBeforeCosine : -1;
    const auto reach = static_cast<float>(waits ? hunt.ambush->noticesMetres : hunt.giveUpMetres);
    onlooker.senses.prey =
        attend(onlooker,
               onlooker.environment.grids->fish,
               fish::Intention::Eat,
               std::min(onlooker.sight(1), reach),
               [&](std::uint32_t other, glm::vec3 offset, float distance) {
                   const bool isMissed =
                       place::dot(onlooker.senses.heading, offset) < leastCosine * distance;
                   return isMissed ? kNever : costOfPrey(onlooker, other, offset, distance);
               });
}

// Reach within which an object could raise a drive over its threshold, at most `sense`; metres.
float worthLooking(
    const Onlooker& onlooker, float inner, float weight, const StimulusRange& range, float sense) {
    const float lacking = (fish::kDesire * fish::kHysteresis - inner) / weight;
    if (lacking <= 0) return sense;
    return std::min(sense, onlooker.senses.length * bodyLengthsOf(range, lacking));
}

bool isInASchool(const Onlooker& onlooker) {
    return onlooker.parameters.habits.role == config::Role::Prey &&
           (onlooker.mind.likes & fish::kLikesSchooling) != 0 &&
           onlooker.senses.schoolmates.count > 0;
}

// A school or a cloud stays together while it feeds: its members go only for plankton beside them,
// and leave for pellets alone. In body lengths.
constexpr float kDartBodyLengths = 2.8F;

bool feedsInCompany(const Onlooker& onlooker) {
    return isInASchool(onlooker) || onlooker.parameters.habits.cloud;
}

bool isWorthLeaving(const Onlooker& onlooker, std::uint32_t particle, float distance) {
    const surroundings::Food& food = onlooker.environment.surroundings->food;
    return food.kind[particle] == surroundings::FoodKind::Pellet || !feedsInCompany(onlooker) ||
           distance < kDartBodyLengths * onlooker.senses.length;
}

// Added cost, in body lengths, of a particle straight behind, for which the fish has to turn round.
constexpr float kComeAboutBodyLengths = 2;

// The way to a particle, and by the angle from the mouth the cost of turning. A fish that pursues
// early takes as the way that of the steepest slope, which is longer for what is above or below it.
float costOfFood(const Onlooker& onlooker, glm::vec3 offset, float distance) {
    const Senses& senses = onlooker.senses;
    const float way = onlooker.environment.adaptation.earlierPursuit
                          ? std::max(distance, std::abs(offset.y) / place::kSteepest)
                          : distance;
    const glm::vec3 fromMouth = offset - senses.heading * (fish::kNoseBodyLengths * senses.length);
    const float cosine = place::dot(place::directionOf(fromMouth, senses.heading), senses.heading);
    return way + 0.5F * kComeAboutBodyLengths * senses.length * (1 - cosine);
}

// Food is sensed in all directions and never hidden, as it smells.
void senseFood(const Onlooker& onlooker) {
    const fish::SpeciesParameters& parameters = onlooker.parameters;
    if (!parameters.habits.hunger.eatsPlankton ||
        parameters.habits.role == config::Role::Predator ||
        fish::isGorged(parameters, onlooker.mind))
        return;
    Senses& senses = onlooker.senses;
    const surroundings::Food& food = onlooker.environment.surroundings->food;
    float smell = std::min(parameters.habits.smellBodyLengths * senses.length, onlooker.clarity());
    if (feedsInCompany(onlooker) && food.pellets == 0)
        smell = std::min(smell, kDartBodyLengths * senses.length);
    const float reach = worthLooking(onlooker,
                                     fish::innerHunger(parameters, onlooker.mind),
                                     kHungerStimulus,
                                     kFoodStimulus,
                                     smell);
    float best = reach / place::kSteepest + kComeAboutBodyLengths * senses.length;
    const std::uint32_t pursued = onlooker.aim.target;
    if (onlooker.aim.intention == fish::Intention::Eat && pursued < food.size() &&
        food.isFree(pursued)) {
        const glm::vec3 offset = food.position(pursued) - senses.position;
        const float distance = place::lengthOf(offset);
        if (distance <= reach) {
            senses.food = {pursued, offset, distance};
            best = costOfFood(onlooker, offset, distance) * (1 - parameters.habits.persistence);
        }
    }
    const Sighting better =
        cheapestIn(onlooker.environment.grids->food,
                   senses.position,
                   reach,
                   best,
                   [&](std::uint32_t particle, glm::vec3 offset, float distance) {
                       return distance <= reach && isWorthLeaving(onlooker, particle, distance)
                                  ? costOfFood(onlooker, offset, distance)
                                  : kNever;
                   });
    if (better.seen()) senses.food = better;
}

// Cost of a mate: its distance times dearnessOfMate(); the blind angle holds for all but the
// present one.
float costOfMate(const Onlooker& onlooker, std::uint32_t other, glm::vec3 offset, float distance) {
    const fish::FishView& view = onlooker.view();
    if (!suitsAsMate(view, onlooker.mind.likes, onlooker.fish, other)) return kNever;
    // It also feels behind it the mate that it courts already.
    if (other != onlooker.aim.target && !inFieldOfView(onlooker.senses.heading, offset))
        return kNever;
    return distance * dearnessOfMate(view, onlooker.mind.likes, onlooker.fish, other);
}

void seeMate(const Onlooker& onlooker) {
    if (!onlooker.senses.hour.mates) return;
    const float hunger = fish::innerHunger(onlooker.parameters, onlooker.mind);
    const float libido = fish::innerLibido(onlooker.parameters, onlooker.mind, hunger);
    if (libido < kTemptedFrom) return;
    // Hunters live alone and know of each other as far as the water is clear.
    const bool isAlone = onlooker.parameters.habits.role == config::Role::Predator;
    const float sight = worthLooking(onlooker,
                                     libido,
                                     kLibidoStimulus,
                                     kMateStimulus,
                                     isAlone ? onlooker.clarity() : onlooker.sight(1));
    onlooker.senses.mate = attend(onlooker,
                                  onlooker.environment.grids->mates,
                                  fish::Intention::Mate,
                                  sight,
                                  [&](std::uint32_t other, glm::vec3 offset, float distance) {
                                      return costOfMate(onlooker, other, offset, distance);
                                  });
}

// Factors for a mate that courts another, and for any other one when the courtship is answered.
constexpr float kTakenDearness = 1.5F;
constexpr float kDevotion = 3;

}  // namespace

Sighting sightingOf(const fish::FishView& view, std::uint32_t other, glm::vec3 position) {
    const glm::vec3 offset = view.position(other) - position;
    return {other, offset, place::lengthOf(offset)};
}

Senses perceive(const Environment& environment,
                const fish::SpeciesParameters& parameters,
                std::uint32_t fish,
                const fish::Mind& mind) {
    assert(environment.view != nullptr);
    assert(environment.grids != nullptr);
    assert(environment.surroundings != nullptr);
    assert(fish < environment.view->size());
    Senses senses;
    feelItself(*environment.view, fish, senses);
    const double time = environment.surroundings->timeOfDay;
    senses.hour.rests = restsAt(parameters, environment.seed, fish, senses.length, time);
    senses.hour.mates = fish::matesAt(parameters, time);
    const Onlooker onlooker{environment, parameters, fish, mind, senses};
    seeNeighbours(onlooker);
    seePredators(onlooker);
    seePrey(onlooker);
    senseFood(onlooker);
    seeMate(onlooker);
    senseShelter(onlooker);
    senses.patch = patchFor(environment, parameters, fish, mind, senses);
    senseTerritory(environment, parameters, fish, mind, senses);
    senseCleaning(environment, parameters, fish, mind, senses);
    if ((mind.likes & fish::kLikesSchooling) != 0 &&
        environment.gathering == config::Gathering::None)
        senses.structure = structureFor(environment, mind, fish, senses);
    feelSurroundings(environment, parameters, fish, mind, senses);
    feelClimate(*environment.surroundings, parameters, mind.likes, senses);
    feelCollision(environment, parameters, fish, mind, senses);
    return senses;
}

bool suitsAsMate(const fish::FishView& view,
                 std::uint8_t likes,
                 std::uint32_t fish,
                 std::uint32_t other) {
    assert(fish < view.size());
    assert(other < view.size());
    if (other == fish || view.kind[other] != view.kind[fish]) return false;
    if (!view.shows(other, fish::kWilling) || view.shows(other, fish::kAway)) return false;
    if (view.shows(other, fish::kFemale) == ((likes & fish::kIsFemale) != 0)) return false;
    const auto [shorter, longer] = std::minmax(view.fish[fish].length, view.fish[other].length);
    return shorter >= kLeastSizeRatio * longer;
}

float dearnessOfMate(const fish::FishView& view,
                     std::uint8_t likes,
                     std::uint32_t fish,
                     std::uint32_t other) {
    const std::uint32_t own = view.partner[fish];
    const bool isCourted = own != fish::kNobody && view.partner[own] == fish;
    const std::uint32_t theirs = view.partner[other];
    float dearness = theirs != fish::kNobody && theirs != fish ? kTakenDearness : 1.0F;
    if (isCourted && own != other) dearness = kDevotion;
    if ((likes & fish::kIsFemale) == 0) return dearness;
    // A cost must not be less than the distance (cheapestIn()), so smaller males cost more instead
    // of larger ones less.
    const float smaller = view.fish[fish].length / (kLeastSizeRatio * view.fish[other].length);
    return dearness * std::max(1.0F, smaller * smaller);
}

}  // namespace aquarama::behaviour
