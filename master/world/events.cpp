// SPDX-License-Identifier: Apache-2.0

#include "master/world/events.h"

#include <algorithm>

#include "common/place/place.h"
#include "common/units/hash.h"
#include "master/behaviour/mental_state.h"
#include "master/fish/fish_view.h"
#include "master/fish/secondary_controller.h"
#include "master/world/beginning.h"
#include "master/world/world.h"

namespace aquarama::world {

namespace {

constexpr std::uint32_t kSwallowTicks = 6;  // a tenth of a second, as suction feeders do
static_assert(kSwallowTicks < fish::kTicksBetweenThoughts);

// The share of the way that is left grows with every tick: it is gulped, not fetched.
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

}  // namespace

Meals makeMeals(std::size_t fish) {
    Meals meals;
    meals.swallows.reserve(fish);
    return meals;
}

void beginSwallow(Meals& meals, std::uint32_t fish, std::uint32_t particle) {
    meals.swallows.push_back({fish, particle, kSwallowTicks});
}

void advanceMeals(Meals& meals, const fish::FishView& view, surroundings::Food& food, Tick tick) {
    for (Meals::Swallow& swallow : meals.swallows) {
        if (view.shows(swallow.fish, fish::kAway))
            swallow.ticksLeft = 1;  // eaten itself: what it had in its mouth goes with it
        else
            drawIn(food, swallow.particle, fish::mouthOf(view, swallow.fish), swallow.ticksLeft);
        if (--swallow.ticksLeft == 0) surroundings::removeFood(food, swallow.particle, tick);
    }
    std::erase_if(meals.swallows,
                  [](const Meals::Swallow& swallow) { return swallow.ticksLeft == 0; });
}

// What the fish did to one another and to the food, done one after the other: of two that want the
// same the first has it.

void World::perform(const fish::DeferredEvent& event) {
    switch (event.kind) {
        case fish::DeferredEventKind::EatParticle:
            if (!surroundings::takeFood(surroundings_.food, event.object)) return;
            beginSwallow(meals_, event.fish, event.object);
            feed(event.fish);
            ++counts_.meals;
            return;
        case fish::DeferredEventKind::EatFish:
            if (motion::isAway(states_, event.object)) return;
            motion::setAway(states_, event.object);
            view_.signs[event.object] = fish::kAway;
            absences_.push_back(absenceFrom(seed_, event.object, tick_));
            feed(event.fish);
            minds_[event.fish].sinceChase = fish::kLongAgo;  // one is enough for a chase
            ++counts_.catches;
            return;
        case fish::DeferredEventKind::Spawn:
            // Whoever spawned in this very tick has no more to give.
            if (minds_[event.fish].sinceSpawning == 0 || minds_[event.object].sinceSpawning == 0)
                return;
            minds_[event.fish].sinceSpawning = 0;
            minds_[event.object].sinceSpawning = 0;
            ++counts_.spawnings;
            return;
    }
}

void World::feed(std::uint32_t fish) {
    if (minds_[fish].eaten < 0xffffU) ++minds_[fish].eaten;
    minds_[fish].sinceMeal = 0;
}

// Those whose time it is come back as others: with a mind and likes of their own.
void World::receive() {
    std::erase_if(absences_, [this](const Absence& absence) {
        if (absence.until.value > tick_.value) return false;
        arrive(absence.fish);
        return true;
    });
}

void World::arrive(std::uint32_t fish) {
    const fish::SpeciesParameters& parameters = speciesParameters_[view_.kind[fish]];
    const glm::vec3 place = arrivalPlace(surroundings_, fish, tick_);
    const glm::vec3 inwards =
        place::directionOf(surroundings_.obstacles.water.centre - place, glm::vec3{1, 0, 0});
    placeFishAt(states_, fish, place, inwards);
    motion::setSpeedBodyLengths(states_, fish, parameters.medium);
    const auto drawn = hashOf(seed_, static_cast<std::uint32_t>(tick_.value));
    minds_[fish] = behaviour::freshMind(parameters, drawn, fish);
    courses_[fish] = {place::levelled(inwards), parameters.medium, 0};
    view_.signs[fish] = 0;
    ++counts_.returns;
}

}  // namespace aquarama::world
