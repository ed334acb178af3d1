// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/perceive/perceive.h"

#include <algorithm>

#include "common/place/angle.h"
#include "master/surroundings/obstacles.h"

namespace aquarama {

namespace {

constexpr float kReachSeconds = 2.2F;  // how far ahead the surroundings are felt
constexpr float kReachMetres = 0.4F;

Sighting sightingOf(std::uint32_t object, glm::vec3 offset) {
    return {object, offset, lengthOf(offset)};
}

void feelSurroundings(const Environment& environment, Senses& senses) {
    const Surroundings& around = *environment.surroundings;
    const float reach = kReachMetres + senses.speed * kReachSeconds;
    const Submarine& submarine = around.submarine;
    senses.push =
        avoidance(around.obstacles, senses.position, senses.heading, reach) +
        ballPush(
            submarine.position, submarine.radiusMetres, senses.position, senses.heading, reach);
    senses.urgency = lengthOf(senses.push);
    senses.submarineMetres = lengthOf(submarine.position - senses.position);
    senses.light = lightAt(around.climate, around.daylight, senses.position.y);
    senses.celsius = celsiusAt(around.climate, senses.position.y);
}

// The nearest point of a grid within reach for which isOne holds.
template <class IsOne>
Sighting nearestIn(const SpatialGrid& grid, glm::vec3 position, float reach, const IsOne& isOne) {
    Sighting nearest;
    float reachSquared = reach * reach;
    grid.visitAround(position, reachSquared, [&](const SpatialGrid::Candidates& row) {
        for (std::size_t i = 0; i < row.index.size(); ++i) {
            const glm::vec3 offset = glm::vec3{row.x[i], row.y[i], row.z[i]} - position;
            const float squared = dot(offset, offset);
            const bool nearer = squared < reachSquared ||
                                (squared == reachSquared && row.index[i] < nearest.object);
            if (!nearer || !isOne(row.index[i], offset)) continue;
            nearest = sightingOf(row.index[i], offset);
            reachSquared = squared;
        }
    });
    return nearest;
}

void seePredators(const Environment& environment, const Nature& nature, Senses& senses) {
    if (nature.huntedBy == 0) return;
    const Sighting nearest =
        nearestIn(environment.grids->predators,
                  senses.position,
                  environment.surroundings->clarityMetres,
                  [&](std::uint32_t other, glm::vec3 offset) {
                      return (nature.huntedBy >> environment.view->kind[other] & 1U) != 0 &&
                             inFieldOfView(senses.heading, offset);
                  });
    if (nearest.seen()) senses.predators[senses.predatorCount++] = nearest;
}

}  // namespace

Senses perceive(const Environment& environment,
                const Nature& nature,
                std::uint32_t fish,
                const Mind& /*mind*/) {
    const FishView& view = *environment.view;
    Senses senses;
    senses.position = view.position(fish);
    senses.heading = view.heading(fish);
    senses.speed = view.speed[fish];
    senses.length = view.length[fish];
    const NearestFish nearest = nearestVisible(view, *environment.grids, nature, fish);
    senses.schoolmates = nearest.schoolmates;
    senses.others = nearest.others;
    seePredators(environment, nature, senses);
    const float smell =
        std::min(nature.smellBodyLengths * senses.length, environment.surroundings->clarityMetres);
    senses.food =
        nearestIn(environment.grids->food, senses.position, smell, [](std::uint32_t, glm::vec3) {
            return true;
        });
    feelSurroundings(environment, senses);
    return senses;
}

}  // namespace aquarama
