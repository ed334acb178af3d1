// SPDX-License-Identifier: Apache-2.0
#include "master/world/events.h"

#include <algorithm>
#include <cassert>

#include "common/base/hash.h"
#include "common/motion/reconstruct.h"
#include "common/place/place.h"
#include "master/behaviour/think.h"
#include "master/fish/fish_view.h"
#include "master/fish/secondary_controller.h"
#include "master/world/beginning.h"
#include "master/world/visits.h"
#include "master/world/world.h"

namespace aquarama::world {

namespace {

// A tenth of a second, as in suction feeders; shorter than the time between two thoughts.
constexpr std::uint32_t kSwallowTicks = 6;
static_assert(kSwallowTicks < fish::kTicksBetweenThoughts);

// Moves the particle by 1 / ticksLeft of the remaining way: the last step ends in the mouth, and
// the particle follows a mouth that moves.
void drawIn(surroundings::Food& food,
            std::uint32_t particle,
            glm::vec3 mouth,
            std::uint32_t ticksLeft) {
    const glm::vec3 from = food.position(particle);
    const glm::vec3 at = from + (mouth - from) / static_cast<float>(ticksLeft);
    food.x[particle] = at.x;
    food.y[particle] = at.y;
    food.z[particle] = at.z;
}

// Where the mouth is seen: the nose, nodal point 0, in the pose that is played.
glm::vec3 mouthOf(const motion::MotorTables& tables,
                  const FishColumns& columns,
                  std::uint32_t fish) {
    body::NodalPoints nodes;
    motion::nodalPoints(tables, columns.traits, columns.states, fish, {&nodes, 1});
    return nodes[0];
}

// Adds one particle or prey to the stomach; the counter saturates.
void feed(fish::Mind& mind) {
    if (mind.eaten < 0xffffU) ++mind.eaten;
    mind.sinceMeal = 0;
}

// The two that lead a shoal remember that one of it was charged.
void remindLeaders(const fish::SpeciesParameters& parameters,
                   std::uint32_t charged,
                   fish::Minds& minds) {
    if (!parameters.habits.graze) return;
    const fish::Household household = fish::householdOf(parameters, charged);
    for (std::uint32_t fish = household.first; fish < std::min(household.last, household.first + 2);
         ++fish) {
        std::uint8_t& memory = minds[fish].charged;
        memory = memory == 0 ? fish::kChargedOnce : fish::kChargedTwice;
    }
}

}  // namespace

Meals makeMeals(std::size_t fish) {
    Meals meals;
    meals.swallows.reserve(fish);
    return meals;
}

void beginSwallow(Meals& meals, std::uint32_t fish, std::uint32_t particle) {
    assert(meals.swallows.size() < meals.swallows.capacity());
    meals.swallows.push_back({fish, particle, kSwallowTicks});
}

// Advances all swallows by one tick: each particle comes nearer to the mouth and vanishes in it.
void World::swallow() {
    for (Meals::Swallow& swallow : meals_.swallows) {
        surroundings::Food& food = surroundings_.food;
        if (columns_.view.shows(swallow.fish, fish::kAway))
            // A fish that was eaten itself: what it had in its mouth goes with it.
            swallow.ticksLeft = 1;
        else
            drawIn(
                food,
                swallow.particle,
                mouthOf(*kinds_[columns_.view.kind[swallow.fish]].tables, columns_, swallow.fish),
                swallow.ticksLeft);
        if (--swallow.ticksLeft == 0) surroundings::removeFood(food, swallow.particle, tick_);
    }
    std::erase_if(meals_.swallows,
                  [](const Meals::Swallow& swallow) { return swallow.ticksLeft == 0; });
}

// Events of a tick, applied one after the other on one thread. Of two fish that want the same thing
// the first in order gets it; the event of the other has no effect.

void World::perform(const fish::DeferredEvent& event) {
    assert(event.fish < columns_.traits.size());
    switch (event.kind) {
        case fish::DeferredEventKind::EatParticle:
            if (!surroundings::takeFood(surroundings_.food, event.object)) return;
            beginSwallow(meals_, event.fish, event.object);
            feed(columns_.minds[event.fish]);
            ++counts_.meals;
            return;
        case fish::DeferredEventKind::EatFish:
            if (motion::isAway(columns_.states, event.object)) return;
            // A chase ends with one catch.
            columns_.minds[event.fish].sinceChase = fish::kLongAgo;
            if (!columns_.wearers.mayBeEaten && columns_.wearers.of(event.object) != nullptr)
                return;
            motion::setAway(columns_.states, event.object);
            columns_.placements.note(event.object, tick_);
            columns_.view.signs[event.object] = fish::kAway;
            absences_.push_back(absenceFrom(seed_, event.object, tick_));
            feed(columns_.minds[event.fish]);
            ++counts_.catches;
            return;
        case fish::DeferredEventKind::Spawn:
            // A fish spawns once a tick at most: 0 ticks since spawning means that it just did.
            if (columns_.minds[event.fish].sinceSpawning == 0 ||
                columns_.minds[event.object].sinceSpawning == 0)
                return;
            columns_.minds[event.fish].sinceSpawning = 0;
            columns_.minds[event.object].sinceSpawning = 0;
            ++counts_.spawnings;
            return;
        case fish::DeferredEventKind::Bite:
            bite(event.fish, event.object);
            return;
        case fish::DeferredEventKind::PuffSand:
            ++counts_.puffs;
            return;
        case fish::DeferredEventKind::Charge:
            remindLeaders(
                speciesParameters_[columns_.view.kind[event.object]], event.object, columns_.minds);
            ++counts_.charges;
            return;
    }
}

// A bite of turf: so many of them count as a particle, but to one that is gorged.
void World::bite(std::uint32_t fish, std::uint32_t patch) {
    if (!surroundings::biteTurf(surroundings_.turf, patch)) return;
    ++counts_.bites;
    const fish::SpeciesParameters& parameters = speciesParameters_[columns_.view.kind[fish]];
    fish::Mind& mind = columns_.minds[fish];
    if (++mind.bites < parameters.habits.graze->bitesPerParticle) return;
    mind.bites = 0;
    if (!fish::isGorged(parameters, mind)) feed(mind);
}

// Lets fish return whose absence is over, each with a new mind and new habits.
void World::receive() {
    std::erase_if(absences_, [this](const Absence& absence) {
        if (absence.until.value > tick_.value) return false;
        arrive(absence.fish);
        return true;
    });
}

// The place of an eaten fish is taken by a new one of its species: it swims in from afar at medium
// speed, towards the middle.
void World::arrive(std::uint32_t fish) {
    const fish::SpeciesParameters& parameters = speciesParameters_[columns_.view.kind[fish]];
    const glm::vec3 at = arrivalPlace(surroundings_, fish, tick_);
    const glm::vec3 inwards =
        place::directionOf(surroundings_.obstacles.water.centre - at, glm::vec3{1, 0, 0});
    putIn(waterNow(), fish, at, inwards, parameters.medium, columns_);
    ++counts_.returns;
}

}  // namespace aquarama::world
