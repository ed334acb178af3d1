// SPDX-License-Identifier: Apache-2.0
// What reaches the world from outside: the only things beside seed and scene that change it, and
// so all that a recording must hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>

#include "common/units/units.h"
#include "master/fish/fish_view.h"
#include "master/surroundings/food.h"

namespace aquarama::world {

// A visitor feeds the fish.
struct DropFood {
    glm::vec3 position{};  // metres, world frame
    std::uint32_t pellets = 12;
};

// Puts the submarine somewhere else: on a stage, not by hand (that is a Steering).
struct MoveSubmarine {
    glm::vec3 position{};
    glm::vec3 velocityMetresPerSecond{};
};

using WorldInput = std::variant<DropFood, MoveSubmarine, Steering>;

// Food on its way into a mouth: a fish that snaps draws it in with the water (Tu 1996, section
// 5.6.3), which takes a few ticks in which all can see it go.

struct Meals {
    struct Swallow {
        std::uint32_t fish = fish::kNobody;
        std::uint32_t particle = fish::kNobody;
        std::uint32_t ticksLeft = 0;
    };
    std::vector<Swallow> swallows;  // in the order in which they began
};

// With room for one of each fish: none snaps again before it has swallowed.
[[nodiscard]] Meals makeMeals(std::size_t fish);
// Of a particle that the fish has taken.
void beginSwallow(Meals& meals, std::uint32_t fish, std::uint32_t particle);
// One tick: each particle comes nearer to the mouth, and vanishes in it.
void advanceMeals(Meals& meals, const fish::FishView& view, surroundings::Food& food, Tick tick);

}  // namespace aquarama::world
