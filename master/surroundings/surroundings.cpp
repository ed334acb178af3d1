// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/surroundings.h"

#include "common/place/water.h"

namespace aquarama {

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
