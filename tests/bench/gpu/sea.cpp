// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/gpu/sea.h"

#include <span>

#include "common/config/scene.h"
#include "common/units/digest.h"
#include "master/simulation/living_world.h"

namespace aquarama::bench {

namespace {

session::Admission admissionTo(const simulation::Assets& assets, const world::World& world) {
    session::Admission admission;
    admission.welcome.seed = assets.bytes.seed;
    const auto school = world.traits();
    admission.welcome.school.assign(school.begin(), school.end());
    admission.scene = assets.scene;
    for (const wire::SpeciesAssets& species : assets.bytes.cast) {
        const auto text = std::as_bytes(std::span{species.text});
        admission.welcome.cast.push_back(
            {digestOf(text), digestOf(species.repertoire), species.fish});
        admission.cast.push_back(species);
    }
    return admission;
}

wire::StateFrame frameAfter(const simulation::LivingWorld& world, const wire::StateFrame& last) {
    wire::FoodCloud food;
    world.food(food);
    wire::StateFrame frame{.frame = {last.frame.value + 1},
                           .tick = world.tick(),
                           .fraction = 0.5F,
                           .eye = world.eye(),
                           .before = last.after,
                           .after = {},
                           .foodOriginMetres = food.originMetres,
                           .foodBefore = last.foodAfter,
                           .foodAfter = food.particles,
                           .daylight = world.daylight()};
    world.records(frame.after);
    return frame;
}

}  // namespace

Sea makeSea(const std::string& scenePath,
            std::optional<std::uint32_t> fish,
            int ticksBefore,
            int frames) {
    const simulation::Assets assets = simulation::readAssets(scenePath, {.seed = 1, .fish = fish});
    simulation::LivingWorld world(simulation::worldOptionsOf(assets));
    for (int i = 0; i < ticksBefore; ++i) world.advance();
    Sea sea{admissionTo(assets, world.world()), {}};
    wire::StateFrame last = frameAfter(world, {});
    for (int i = 0; i < frames; ++i) {
        world.advance();
        last = frameAfter(world, last);
        sea.frames.push_back(last);
    }
    return sea;
}

}  // namespace aquarama::bench
