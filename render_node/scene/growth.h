// SPDX-License-Identifier: Apache-2.0
// The forms of what grows on a reef, each in a few shapes: hard and soft corals, sponges, plants.
#pragma once

#include <array>
#include <cstdint>

#include "render_node/scene/mesh.h"

namespace aquarama::scene {

enum class Form : std::uint8_t {
    // Hard corals.
    Staghorn,
    Bush,
    Fingers,
    Table,
    Brain,
    Lobes,
    Leaves,
    Crust,
    // Soft ones, sponges and their company.
    Fan,
    Whips,
    Tubes,
    Barrel,
    Leather,
    SoftTree,
    Anemone,
    Feathers,
    // Plants.
    Turf,
    Kelp,
    Seagrass,
};
inline constexpr std::size_t kForms = 19;
inline constexpr int kShapesOfForm = 3;

// In a frame of its own: y up, the foot at the origin, about 1 in size. Albedos are shares of half
// the tint.
[[nodiscard]] Levels grow(Form form, int shape);

}  // namespace aquarama::scene
