// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/gpu/sea.h"

#include <utility>

#include "common/base/digest.h"
#include "common/config/scene.h"
#include "master/simulation/living_world.h"

namespace aquarama::bench {

namespace {

session::Admission admissionTo(const simulation::Assets& assets, const world::World& world) {
    session::Admission admission;
    admission.seed = assets.bytes.seed;
    const auto school = world.traits();
    admission.school.assign(school.begin(), school.end());
    admission.scene = assets.scene;
    admission.cast = assets.bytes.cast;
    return admission;
}

wire::StateFrame frameAfter(const simulation::LivingWorld& world, const wire::StateFrame& last) {
    conductor::Snapshot now = world.snapshot();
    return {{.frame = {last.frame.value + 1},
             .tick = now.tick,
             .fraction = 0.5F,
             .eye = now.eye,
             .foodOriginMetres = now.food.originMetres,
             .foodBefore = last.foodAfter,
             .foodAfter = std::move(now.food.particles),
             .timeOfDay = now.timeOfDay,
             .show = {}},
            last.after,
            std::move(now.fish),
            true};
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
