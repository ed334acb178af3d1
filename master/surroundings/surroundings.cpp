// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/surroundings.h"

#include <cmath>

namespace aquarama {

Region waterFor(const Scene& scene, std::size_t fish, float meanLengthMetres) {
    Region water{scene.water.centre, scene.water.halfExtent};
    if (scene.place != PlaceKind::OpenSea) return water;
    const double metres = meanLengthMetres;
    const double wanted =
        static_cast<double>(fish) * scene.water.leastLengthsCubed * metres * metres * metres;
    const glm::dvec3 half = water.halfExtent;
    const double has = 8 * half.x * half.y * half.z;
    if (wanted <= has) return water;
    // Depth grows only as the fourth root of what length and breadth grow by: the sea is shallow.
    const double more = wanted / has;
    const double higher = std::sqrt(std::sqrt(std::sqrt(more)));
    const double wider = std::sqrt(more / higher);
    water.halfExtent.x = static_cast<float>(half.x * wider);
    water.halfExtent.y = static_cast<float>(half.y * higher);
    water.halfExtent.z = static_cast<float>(half.z * wider);
    return water;
}

Surroundings makeSurroundings(const Scene& scene,
                              std::uint32_t seed,
                              std::size_t fish,
                              float meanLengthMetres) {
    const Obstacles obstacles =
        obstaclesOf({seed, scene.place}, waterFor(scene, fish, meanLengthMetres));
    return {.seed = seed,
            .obstacles = obstacles,
            .climate = climateOf(scene),
            .food = makeFood(seed, obstacles, scene.plankton),
            .submarine = {.position = scene.eye},
            .clarityMetres = static_cast<float>(scene.water.clarityMetres),
            .daylight = daylight(scene.day, {})};
}

void advanceSurroundings(Surroundings& surroundings, Tick tick) {
    surroundings.daylight = daylight(surroundings.climate.day, tick);
    driftFood(surroundings.food, surroundings.seed, surroundings.obstacles, tick);
}

}  // namespace aquarama
