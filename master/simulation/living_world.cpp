// SPDX-License-Identifier: Apache-2.0
#include "master/simulation/living_world.h"

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

// As the nodes are told of it.
wire::FoodCloud foodOf(const surroundings::Surroundings& around) {
    const surroundings::Food& food = around.food;
    wire::FoodCloud cloud{around.obstacles.water.centre, {}};
    cloud.particles.reserve(food.size());
    for (std::size_t i = 0; i < food.size(); ++i)
        cloud.particles.push_back(wire::foodRecord(
            kindOf(food.kind[i]), food.position(i) - cloud.originMetres, food.generation[i]));
    return cloud;
}

wire::Eye eyeOf(const pilot::Vessel& vessel) {
    const motion::Quaternion q = pilot::worldFromBody(vessel.attitude);
    return {.positionMetres = vessel.position, .worldFromWall = {q.w, q.x, q.y, q.z}};
}

}  // namespace

LivingWorld::LivingWorld(const world::WorldOptions& options) : world_(options) {
    for (const world::WorldSpecies& species : options.cast) species_.push_back(species.name);
}

conductor::Snapshot LivingWorld::snapshot() const {
    conductor::Snapshot snapshot{.tick = world_.tick(),
                                 .hash = world_.hash(),
                                 .eye = eyeOf(world_.pilot().vessel),
                                 .daylight = world_.surroundings().daylight,
                                 .fish = {},
                                 .food = foodOf(world_.surroundings())};
    world_.records(snapshot.fish);
    return snapshot;
}

std::vector<std::string> LivingWorld::explain(std::uint32_t fish) const {
    const auto insight = insightInto(world_, fish);
    return insight ? linesOf(*insight, {world_.view(), species_}) : std::vector<std::string>{};
}

}  // namespace aquarama::simulation
