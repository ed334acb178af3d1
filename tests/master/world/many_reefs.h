// SPDX-License-Identifier: Apache-2.0
// The reef of reef_full many times over: its cast, its sites and its plankton on a grid, at
// unchanged density. For figures of worlds of very many fish.
#pragma once

#include <cstddef>
#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/motion/motion_state.h"
#include "common/place/place.h"
#include "common/place/reefs.h"
#include "master/world/world.h"
#include "master/world/world_state.h"
#include "tests/master/world/captured_fish.h"

namespace aquarama::world {

// So many reefs side by side and behind one another.
inline WorldOptions optionsOfReefs(glm::uvec2 reefs, unsigned threads) {
    WorldOptions options = optionsOfScene("reef_full");
    const std::uint32_t count = reefs.x * reefs.y;
    config::SceneWater& water = options.scene.water;
    const glm::vec3 one = water.halfExtent;
    water.halfExtent = one * glm::vec3{reefs.x, 1, reefs.y};
    water.centre += glm::vec3{water.halfExtent.x - one.x, 0, one.z - water.halfExtent.z};
    options.scene.reefs = reefs;
    options.scene.plankton *= count;
    options.scene.livedSeconds = 0;
    for (WorldSpecies& species : options.cast) species.fish *= count;
    options.threads = threads;
    return options;
}

// The school of each reef begins as that of the first would alone.
inline void placeSchools(World& world, const WorldOptions& options) {
    const World alone(optionsOfReefs({1, 1}, 1));
    const std::size_t school = alone.speciesParameters().front().last;
    const place::PlaceKey place = place::placeOf(options.scene, options.seed);
    WorldState state;
    world.save(state);
    for (std::size_t reef = 0; reef < place::reefsOf(place); ++reef)
        for (std::size_t fish = 0; fish < school; ++fish) {
            motion::BodyFrame frame = motion::bodyFrameOf(alone.states(), fish);
            frame.position += place::reefOffset(place, reef);
            motion::setBodyFrame(state.states, reef * school + fish, frame);
        }
    world.restore(state);
}

}  // namespace aquarama::world
