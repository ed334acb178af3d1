// SPDX-License-Identifier: Apache-2.0

#include "master/behaviour/perceive.h"

#include <algorithm>
#include <array>
#include <limits>

#include "common/place/place.h"
#include "master/behaviour/points_within.h"
#include "master/behaviour/vision.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"
#include "master/surroundings/obstacles.h"

namespace aquarama::behaviour {

namespace {

constexpr float kReachSeconds = 2.2F;  // how far ahead the surroundings are felt
constexpr float kReachMetres = 0.4F;
constexpr float kBowWaveSeconds = 1.0F;  // of the submarine's way, by which it seems larger

// b1, b2 of a predator's cost of a prey: schooling and turning make it dearer (Tu &
// Terzopoulos 1994).
constexpr float kSchoolingCost = 0.5F;
constexpr float kTurningCost = 0.2F;

// Who looks, and what it is about.
struct Onlooker {
    const Environment& environment;
    const fish::SpeciesParameters& parameters;
    std::uint32_t fish;
    const fish::Mind& mind;
    Senses& senses;
    fish::Aim aim = fish::aimOf(mind);

    [[nodiscard]] const fish::FishView& view() const { return *environment.view; }
    [[nodiscard]] float clarity() const { return environment.surroundings->clarityMetres; }
    [[nodiscard]] float sight(float conspicuous) const {
        return sightMetres(parameters, senses.length, conspicuous, clarity());
    }
    [[nodiscard]] bool isHidden(const Sighting& sighting) const {
        return behaviour::isHidden(
            environment, fish, sighting.object, {senses.position, sighting.offset});
    }
    // Of a fish that is there; not whether anything is in between.
    [[nodiscard]] Sighting sightingOf(std::uint32_t other) const {
        const glm::vec3 offset = view().position(other) - senses.position;
        return {other, offset, place::lengthOf(offset)};
    }
};

// Within so few cells all are looked at; farther, from the fish outwards, until none can cost less.
constexpr float kNearCells = 1.5F;

// Searches a grid for what costs least. costOf(index, offset, distance) must be `distance` or more,
// and infinite for what is not sought, as all beyond reach; what costs `best` or more is passed
// over. Of equal costs the lower index has it.
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
    // They are looked at last, when they have come from memory.
    for (const Neighbours* those : {&onlooker.senses.schoolmates, &onlooker.senses.others})
        for (std::size_t i = 0; i < those->count; ++i) onlooker.view().fetch(those->fish[i]);
}

// Keeps the nearest, sorted; of equally near ones the lower index first.
void insert(Senses& senses, const Sighting& predator) {
    const auto isNearer = [&](std::size_t place) {
        const Sighting& other = senses.predators[place];
        return predator.distance < other.distance ||
               (predator.distance == other.distance && predator.object < other.object);
    };
    if (senses.predatorCount == kMostPredators && !isNearer(kMostPredators - 1)) return;
    if (senses.predatorCount < kMostPredators) ++senses.predatorCount;
    std::size_t place = senses.predatorCount - 1;
    for (; place > 0 && isNearer(place - 1); --place)
        senses.predators[place] = senses.predators[place - 1];
    senses.predators[place] = predator;
}

// Behind rock, sand or a nearer one of them.
void forgetHiddenPredators(const Onlooker& onlooker) {
    Senses& senses = onlooker.senses;
    const std::array<Sighting, kMostPredators> looked = senses.predators;
    const std::size_t count = senses.predatorCount;
    const surroundings::Obstacles& obstacles = onlooker.environment.surroundings->obstacles;
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

// An alarmed fish looks about: it does not lose what it flees from in its blind angle.
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
        insert(senses, {other, offset, std::sqrt(squared), view.shows(other, fish::kHunting)});
        const float farthest = senses.predators[kMostPredators - 1].distance;
        if (senses.predatorCount == kMostPredators)
            reachSquared = std::min(reachSquared, farthest * farthest);
    };
    visitPointsWithin(onlooker.environment.grids->predators, senses.position, reachSquared, notice);
    forgetHiddenPredators(onlooker);
}

bool mayHunt(const Onlooker& onlooker) {
    if (onlooker.parameters.habits.role != config::Role::Predator || onlooker.parameters.hunts == 0)
        return false;
    return fish::innerHunger(onlooker.parameters, onlooker.mind) >
           fish::kDesire * fish::kHysteresis;
}

// C_k = d_k (1 + b1 S_k + b2 E_k / pi).
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

// The target that a fish pursues is kept while it is in sight and no other is better by the fish's
// persistence. Of the two only these are looked at for what hides them.
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

// What is so far off that a chase would be given up is not hunted at all.
void seePrey(const Onlooker& onlooker) {
    if (!mayHunt(onlooker)) return;
    const float giveUp = static_cast<float>(onlooker.parameters.habits.hunt.giveUpMetres);
    onlooker.senses.prey = attend(onlooker,
                                  onlooker.environment.grids->fish,
                                  fish::Intention::Eat,
                                  std::min(onlooker.sight(1), giveUp),
                                  [&](std::uint32_t other, glm::vec3 offset, float distance) {
                                      return costOfPrey(onlooker, other, offset, distance);
                                  });
}

// How far it is worth looking for what would raise a drive above its threshold.
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

// A school that feeds stays one: its members dart at the plankton beside them, and leave it for
// pellets alone.
constexpr float kDartBodyLengths = 2.5F;

bool isWorthLeaving(const Onlooker& onlooker, std::uint32_t particle, float distance) {
    const surroundings::Food& food = onlooker.environment.surroundings->food;
    return food.kind[particle] == surroundings::FoodKind::Pellet || !isInASchool(onlooker) ||
           distance < kDartBodyLengths * onlooker.senses.length;
}

// What is before the mouth costs its distance alone; for what is behind, a fish has to come about.
constexpr float kComeAboutBodyLengths = 2;

float costOfFood(const Senses& senses, glm::vec3 offset, float distance) {
    const glm::vec3 fromMouth = offset - senses.heading * (fish::kMouthBodyLengths * senses.length);
    const float cosine = place::dot(place::directionOf(fromMouth, senses.heading), senses.heading);
    return distance + 0.5F * kComeAboutBodyLengths * senses.length * (1 - cosine);
}

// Food is sensed in all directions, and never hidden: it smells.
void senseFood(const Onlooker& onlooker) {
    const fish::SpeciesParameters& parameters = onlooker.parameters;
    if (!parameters.habits.eatsPlankton || parameters.habits.role == config::Role::Predator ||
        fish::isGorged(parameters, onlooker.mind))
        return;
    Senses& senses = onlooker.senses;
    const surroundings::Food& food = onlooker.environment.surroundings->food;
    float smell = std::min(parameters.habits.smellBodyLengths * senses.length, onlooker.clarity());
    if (isInASchool(onlooker) && food.pellets == 0)
        smell = std::min(smell, kDartBodyLengths * senses.length);
    const float reach = worthLooking(onlooker,
                                     fish::innerHunger(parameters, onlooker.mind),
                                     kHungerStimulus,
                                     kFoodStimulus,
                                     smell);
    float best = reach + kComeAboutBodyLengths * senses.length;
    const std::uint32_t pursued = onlooker.aim.target;
    if (onlooker.aim.intention == fish::Intention::Eat && pursued < food.size() &&
        food.isFree(pursued)) {
        const glm::vec3 offset = food.position(pursued) - senses.position;
        const float distance = place::lengthOf(offset);
        if (distance <= reach) {
            senses.food = {pursued, offset, distance};
            best = costOfFood(senses, offset, distance) * (1 - parameters.habits.persistence);
        }
    }
    const Sighting better =
        cheapestIn(onlooker.environment.grids->food,
                   senses.position,
                   reach,
                   best,
                   [&](std::uint32_t particle, glm::vec3 offset, float distance) {
                       return distance <= reach && isWorthLeaving(onlooker, particle, distance)
                                  ? costOfFood(senses, offset, distance)
                                  : kNever;
                   });
    if (better.seen()) senses.food = better;
}

// A male courts the nearest; a female prefers the larger among the near, and him who courts her.
float costOfMate(const Onlooker& onlooker, std::uint32_t other, glm::vec3 offset, float distance) {
    const fish::FishView& view = onlooker.view();
    if (!suitsAsMate(view, onlooker.mind.likes, onlooker.fish, other)) return kNever;
    // Whom it courts already it feels behind it too.
    if (other != onlooker.aim.target && !inFieldOfView(onlooker.senses.heading, offset))
        return kNever;
    return distance * dearnessOfMate(view, onlooker.mind.likes, onlooker.fish, other);
}

void seeMate(const Onlooker& onlooker) {
    if (!fish::mates(onlooker.parameters)) return;
    const float hunger = fish::innerHunger(onlooker.parameters, onlooker.mind);
    const float libido = fish::innerLibido(onlooker.parameters, onlooker.mind, hunger);
    if (libido < kTemptedFrom) return;
    const float sight =
        worthLooking(onlooker, libido, kLibidoStimulus, kMateStimulus, onlooker.sight(1));
    onlooker.senses.mate = attend(onlooker,
                                  onlooker.environment.grids->mates,
                                  fish::Intention::Mate,
                                  sight,
                                  [&](std::uint32_t other, glm::vec3 offset, float distance) {
                                      return costOfMate(onlooker, other, offset, distance);
                                  });
}

// The way that is felt ahead is the one past the submarine, which comes to meet the fish or
// overtakes it; one that comes on is felt from farther.
glm::vec3 submarinePush(const surroundings::Submarine& submarine,
                        const Senses& senses,
                        float reach) {
    const glm::vec3 velocity = submarine.velocityMetresPerSecond;
    if (velocity == glm::vec3{})
        return surroundings::ballPush(
            submarine.position, submarine.radiusMetres, senses.position, senses.heading, reach);
    const glm::vec3 past = senses.heading * reach - velocity * kReachSeconds;
    const glm::vec3 towards = place::directionOf(senses.position - submarine.position, {});
    const float comingOn = std::max(0.0F, place::dot(velocity, towards));
    return surroundings::ballPush(submarine.position,
                                  submarine.radiusMetres + comingOn * kBowWaveSeconds,
                                  senses.position,
                                  place::directionOf(past, senses.heading),
                                  place::lengthOf(past));
}

void feelSurroundings(const Environment& environment, Senses& senses) {
    const surroundings::Surroundings& around = *environment.surroundings;
    const float reach = kReachMetres + senses.speed * kReachSeconds;
    const surroundings::Submarine& submarine = around.submarine;
    const glm::vec3 fromSubmarine = submarinePush(submarine, senses, reach);
    senses.push =
        surroundings::avoidance(around.obstacles, senses.position, senses.heading, reach) +
        fromSubmarine;
    if (submarine.velocityMetresPerSecond != glm::vec3{})
        senses.hurry = std::min(1.0F, place::lengthOf(fromSubmarine));
    senses.urgency = place::lengthOf(senses.push);
    senses.submarineMetres = place::lengthOf(submarine.position - senses.position);
}

}  // namespace

Senses perceive(const Environment& environment,
                const fish::SpeciesParameters& parameters,
                std::uint32_t fish,
                const fish::Mind& mind) {
    Senses senses;
    feelItself(*environment.view, fish, senses);
    const Onlooker onlooker{environment, parameters, fish, mind, senses};
    seeNeighbours(onlooker);
    seePredators(onlooker);
    seePrey(onlooker);
    senseFood(onlooker);
    seeMate(onlooker);
    feelSurroundings(environment, senses);
    feelClimate(*environment.surroundings, parameters, mind.likes, senses);
    feelCollision(environment, parameters, fish, mind, senses);
    return senses;
}

namespace {

constexpr float kDegreesOfComfort = 10;  // weigh as much as all the light there is
constexpr float kNoticeable = 0.02F;     // less difference between here and there moves no fish

struct Ambient {
    float light, celsius;
};

Ambient ambientAt(const surroundings::Surroundings& around, float y) {
    return {surroundings::lightAt(around.climate, around.daylight, y),
            surroundings::celsiusAt(around.climate, y)};
}

// How far the ambient is outside what a habit likes; each habit minds one side of one range.
float lackOf(fish::Like habit, const config::Habits& habits, const Ambient& ambient) {
    switch (habit) {
        case fish::kLikesBrightness:
            return static_cast<float>(habits.light.least) - ambient.light;
        case fish::kLikesDarkness:
            return ambient.light - static_cast<float>(habits.light.most);
        case fish::kLikesWarmth:
            return (static_cast<float>(habits.waterCelsius.least) - ambient.celsius) /
                   kDegreesOfComfort;
        case fish::kLikesCold:
            return (ambient.celsius - static_cast<float>(habits.waterCelsius.most)) /
                   kDegreesOfComfort;
        default:
            return -1;
    }
}

}  // namespace

void feelClimate(const surroundings::Surroundings& around,
                 const fish::SpeciesParameters& parameters,
                 std::uint8_t likes,
                 Senses& senses) {
    const Ambient here = ambientAt(around, senses.position.y);
    senses.light = here.light;
    senses.celsius = here.celsius;
    fish::Like worst = fish::kIsFemale;
    for (const fish::Like habit :
         {fish::kLikesBrightness, fish::kLikesDarkness, fish::kLikesWarmth, fish::kLikesCold}) {
        if ((likes & habit) == 0) continue;
        const float lack = lackOf(habit, parameters.habits, here);
        if (lack <= senses.discomfort) continue;
        senses.discomfort = lack;
        worst = habit;
    }
    if (senses.discomfort <= -kNoticeable) return;  // at ease
    // Light and warmth change with depth alone: the best place is the top or the bottom.
    const place::Region& water = around.obstacles.water;
    const float atTop =
        lackOf(worst, parameters.habits, ambientAt(around, water.centre.y + water.halfExtent.y));
    const float atBottom =
        lackOf(worst, parameters.habits, ambientAt(around, water.centre.y - water.halfExtent.y));
    const float best = std::min(atTop, atBottom);
    if (senses.discomfort - best > kNoticeable) senses.betterUp = atTop < atBottom ? 1.0F : -1.0F;
}

namespace {

constexpr float kTakenDearness = 1.5F;  // of one that courts another
constexpr float kDevotion = 3;          // of anybody else to one whose courtship is answered

}  // namespace

bool suitsAsMate(const fish::FishView& view,
                 std::uint8_t likes,
                 std::uint32_t fish,
                 std::uint32_t other) {
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
    // Nothing may cost less than its distance: so the smaller are dearer.
    const float smaller = view.fish[fish].length / (kLeastSizeRatio * view.fish[other].length);
    return dearness * std::max(1.0F, smaller * smaller);
}

}  // namespace aquarama::behaviour
