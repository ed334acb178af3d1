// SPDX-License-Identifier: Apache-2.0
#include "master/world/population.h"

#include <algorithm>

#include "common/place/angle.h"
#include "common/units/random_streams.h"

namespace aquarama::world {

namespace {

// Streams of one seed: what a number is drawn for.
constexpr std::uint32_t kShortestAbsence = 20 * 60;  // ticks
constexpr std::uint32_t kLongestAbsence = 60 * 60;
constexpr float kHazeMetres = 12;        // beyond, the haze has swallowed a fish of the school
constexpr float kShore = 0.85F;          // of the water's half extent
constexpr float kSurfaceRoomMetres = 1;  // under the surface
constexpr float kFloorRoomMetres = 1;    // over the sand
constexpr float kRockRoomMetres = 1;
constexpr std::uint32_t kPlacesTried = 16;

glm::vec3 placeDrawn(const surroundings::Obstacles& obstacles, std::uint32_t hash) {
    const glm::vec3 share{
        signedUnitOf(hash), signedUnitOf(hashOf(hash, 1)), signedUnitOf(hashOf(hash, 2))};
    glm::vec3 place = obstacles.water.centre + obstacles.water.halfExtent * share * kShore;
    const float lowest = place::floorHeight(obstacles.place, {place.x, place.z}) + kFloorRoomMetres;
    place.y = std::min(std::max(place.y, lowest), -kSurfaceRoomMetres);
    return place;
}

bool isClear(const surroundings::Obstacles& obstacles, glm::vec3 place) {
    return std::ranges::none_of(obstacles.rocks, [&](const place::Rock& rock) {
        return place::lengthOf(place - rock.centre) < rock.radiusMetres + kRockRoomMetres;
    });
}

}  // namespace

std::vector<Absence> makeAbsences(std::span<const fish::SpeciesParameters> speciesParameters) {
    std::size_t hunted = 0;
    for (const fish::SpeciesParameters& parameters : speciesParameters)
        if (parameters.huntedBy != 0) hunted += parameters.last - parameters.first;
    std::vector<Absence> absences;
    absences.reserve(hunted);
    return absences;
}

Absence absenceFrom(std::uint32_t seed, std::uint32_t fish, Tick now) {
    const std::uint32_t hash =
        hashOf(hashOf(hashOf(seed, Stream::Absence), fish), static_cast<std::uint32_t>(now.value));
    return {fish, {now.value + kShortestAbsence + hash % (kLongestAbsence - kShortestAbsence)}};
}

glm::vec3 arrivalPlace(const surroundings::Surroundings& surroundings,
                       std::uint32_t fish,
                       Tick tick) {
    const std::uint32_t own = hashOf(hashOf(hashOf(surroundings.seed, Stream::Arrival), fish),
                                     static_cast<std::uint32_t>(tick.value));
    glm::vec3 best = surroundings.obstacles.water.centre;
    float farthest = -1;
    for (std::uint32_t i = 0; i < kPlacesTried; ++i) {
        const glm::vec3 place = placeDrawn(surroundings.obstacles, hashOf(own, i));
        if (!isClear(surroundings.obstacles, place)) continue;
        const float far =
            std::min(place::lengthOf(place - surroundings.submarine.position), kHazeMetres);
        if (far <= farthest) continue;
        farthest = far;
        best = place;
    }
    return best;
}

}  // namespace aquarama::world
