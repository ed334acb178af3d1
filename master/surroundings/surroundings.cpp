// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/surroundings.h"

#include "common/place/water.h"
#include "common/units/folded_hash.h"

namespace aquarama::surroundings {

namespace {

void dropWhatIsDue(Surroundings& surroundings, Tick tick) {
    const double now = static_cast<double>(tick.value) / static_cast<double>(kTicksPerSecond);
    for (; surroundings.nextDrop < surroundings.drops.size(); ++surroundings.nextDrop) {
        const config::FoodDrop& drop = surroundings.drops[surroundings.nextDrop];
        if (drop.atSeconds > now) return;
        dropPellets(surroundings.food,
                    surroundings.seed,
                    surroundings.obstacles,
                    drop.position,
                    drop.pellets,
                    tick);
    }
}

}  // namespace

Surroundings makeSurroundings(const config::Scene& scene,
                              std::uint32_t seed,
                              std::size_t fish,
                              float meanLengthMetres) {
    const Obstacles obstacles =
        obstaclesOf({seed, scene.place}, place::waterFor(scene, fish, meanLengthMetres));
    return {.seed = seed,
            .obstacles = obstacles,
            .climate = climateOf(scene),
            .food = makeFood(seed, obstacles, scene.plankton),
            .submarine = {.position = scene.eye},
            .clarityMetres = static_cast<float>(scene.water.clarityMetres),
            .daylight = daylight(scene.day, {}),
            .drops = scene.drops};
}

void advanceSurroundings(Surroundings& surroundings, Tick tick) {
    surroundings.daylight = daylight(surroundings.climate.day, tick);
    dropWhatIsDue(surroundings, tick);
    driftFood(surroundings.food, surroundings.seed, surroundings.obstacles, tick);
}

std::uint64_t foldedSurroundings(std::uint64_t hash, const Surroundings& surroundings) {
    const Food& food = surroundings.food;
    for (const auto* values : {&food.x, &food.y, &food.z, &food.lowest})
        hash = folded(hash, *values);
    hash = folded(hash, food.kind);
    hash = folded(hash, food.taken);
    hash = folded(hash, food.generation);
    hash = folded(hash, food.absentUntil);
    return hash;
}

}  // namespace aquarama::surroundings
