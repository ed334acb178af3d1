// SPDX-License-Identifier: Apache-2.0
#include "master/simulation/living_world.h"

#include "common/wire/food_record.h"
#include "master/simulation/insight.h"
#include "master/simulation/lines.h"

namespace aquarama::simulation {

namespace {

wire::FoodRecord::Kind kindOf(surroundings::FoodKind kind) {
    switch (kind) {
        case surroundings::FoodKind::Plankton:
            return wire::FoodRecord::Kind::Plankton;
        case surroundings::FoodKind::Pellet:
            return wire::FoodRecord::Kind::Pellet;
        case surroundings::FoodKind::None:
            break;
    }
    return wire::FoodRecord::Kind::None;
}

}  // namespace

LivingWorld::LivingWorld(const world::WorldOptions& options) : world_(options) {
    for (const world::WorldSpecies& species : options.cast) species_.push_back(species.name);
}

// As the nodes are told of it.
void LivingWorld::food(wire::FoodCloud& cloud) const {
    const surroundings::Food& food = world_.surroundings().food;
    cloud.originMetres = world_.surroundings().obstacles.water.centre;
    cloud.particles.resize(food.size());
    for (std::size_t i = 0; i < food.size(); ++i)
        cloud.particles[i] = wire::foodRecord(
            kindOf(food.kind[i]), food.position(i) - cloud.originMetres, food.generation[i]);
}

wire::Eye LivingWorld::eye() const {
    const pilot::Vessel& vessel = world_.pilot().vessel;
    const motion::Quaternion q = pilot::worldFromBody(vessel.attitude);
    return {.positionMetres = vessel.position, .worldFromWall = {q.w, q.x, q.y, q.z}};
}

wire::Explanation LivingWorld::explain(std::uint32_t fish) const {
    wire::Explanation explanation{
        fish, static_cast<std::uint32_t>(world_.traits().size()), world_.tick(), {}};
    if (const auto insight = insightInto(world_, fish))
        explanation.lines = linesOf(*insight, {world_.view(), species_});
    return explanation;
}

}  // namespace aquarama::simulation
