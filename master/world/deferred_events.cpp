// SPDX-License-Identifier: Apache-2.0
// What the fish did to one another and to the food, done one after the other: of two that want the
// same the first has it.
#include <algorithm>

#include "common/place/angle.h"
#include "common/units/hash.h"
#include "master/behaviour/temperament.h"
#include "master/world/beginning.h"
#include "master/world/world.h"

namespace aquarama::world {

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
