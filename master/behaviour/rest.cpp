// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "common/base/random_streams.h"
#include "common/place/place.h"
#include "master/behaviour/company.h"
#include "master/behaviour/home.h"
#include "master/behaviour/intention_generator.h"
#include "master/behaviour/routines.h"

namespace aquarama::behaviour {

namespace {

// At this distance from its place in the shelter, in lengths, a fish has arrived.
constexpr float kArrivedLengths = 1;
// Share of the slow gait at which it keeps its place.
constexpr float kStillPace = 0.1F;
// Without a shelter: the height above the sand at which it stands, where its home is not over a
// boulder, and how far from the middle of its home, as a share of the home's radius.
constexpr float kAboveSandMetres = 0.8F;
constexpr float kAboutHome = 0.5F;

fish::Course restInShelter(const Situation& situation) {
    const Senses& senses = situation.senses;
    const fish::SpeciesParameters& parameters = situation.parameters;
    const glm::vec3 towards = placeInShelter(situation);
    const float lengths = place::lengthOf(towards) / senses.length;
    if (lengths > kArrivedLengths) {
        const glm::vec3 direction =
            place::directionOf(towards + senses.push * senses.length, senses.heading);
        return {
            steeply(direction), std::min(parameters.medium, parameters.slow + 0.2F * lengths), 0};
    }
    return {place::levelled(senses.heading), kStillPace * parameters.slow, 0};
}

// The place in which a fish without a shelter rests, relative to it.
glm::vec3 lowPlace(const Situation& situation) {
    const Senses& senses = situation.senses;
    const place::Obstacles& obstacles = situation.environment.surroundings->obstacles;
    glm::vec3 place = senses.position;
    if (!situation.parameters.homes.empty()) {
        const std::uint32_t own =
            hashOf(situation.environment.seed, Stream::RestingPlaces, situation.fish);
        const auto radius = static_cast<float>(situation.parameters.habits.home.radiusMetres);
        place =
            homeOf(situation.parameters, situation.fish) +
            glm::vec3{signedUnitOf(own), 0, signedUnitOf(hashOf(own, 1))} * (kAboutHome * radius);
    }
    if (situation.parameters.habits.home.onTheReef) return place - senses.position;
    const float lowest = obstacles.water.centre.y - obstacles.water.halfExtent.y;
    const float sand = obstacles.chart.covers({place.x, place.z})
                           ? obstacles.chart.sand({place.x, place.z})
                           : lowest;
    place.y = std::max(lowest, sand) + kAboveSandMetres;
    return place - senses.position;
}

}  // namespace

fish::Course rest(const Situation& situation) {
    if (situation.senses.shelter.site.seen()) return restInShelter(situation);
    return keepStation(situation, lowPlace(situation));
}

}  // namespace aquarama::behaviour
