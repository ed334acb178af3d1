// SPDX-License-Identifier: Apache-2.0
#include "master/production/living_world.h"

#include "common/wire/food_record.h"
#include "master/explain/insight.h"
#include "master/explain/lines.h"

namespace aquarama {

namespace {

FoodRecord::Kind kindOf(FoodKind kind) {
    switch (kind) {
        case FoodKind::Plankton:
            return FoodRecord::Kind::Plankton;
        case FoodKind::Pellet:
            return FoodRecord::Kind::Pellet;
        case FoodKind::None:
            break;
    }
    return FoodRecord::Kind::None;
}

}  // namespace

LivingWorld::LivingWorld(const WorldOptions& options) : world_(options) {
    for (const WorldSpecies& species : options.cast) species_.push_back(species.name);
}

// As the nodes are told of it.
void LivingWorld::food(FoodCloud& cloud) const {
    const Food& food = world_.surroundings().food;
    cloud.originMetres = world_.surroundings().obstacles.water.centre;
    cloud.particles.resize(food.size());
    for (std::size_t i = 0; i < food.size(); ++i)
        cloud.particles[i] = foodRecord(
            kindOf(food.kind[i]), food.position(i) - cloud.originMetres, food.generation[i]);
}

Eye LivingWorld::eye() const {
    const Vessel& vessel = world_.pilot().vessel;
    const Quaternion q = worldFromBody(vessel.attitude);
    return {.positionMetres = vessel.position, .worldFromWall = {q.w, q.x, q.y, q.z}};
}

Explanation LivingWorld::explain(std::uint32_t fish) const {
    Explanation explanation{
        fish, static_cast<std::uint32_t>(world_.traits().size()), world_.tick(), {}};
    if (const auto insight = insightInto(world_, fish))
        explanation.lines = linesOf(*insight, {world_.view(), species_});
    return explanation;
}

}  // namespace aquarama
