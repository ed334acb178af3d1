// SPDX-License-Identifier: Apache-2.0
// Inputs of the world. Beside seed and scene they are the only things that change it, so a
// recording holds just these. Also the particles of food that are being swallowed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>
#include <vector>

#include <glm/vec3.hpp>

#include "common/base/digest.h"
#include "common/base/units.h"
#include "common/base/wall_hands.h"
#include "master/fish/fish_view.h"
#include "master/surroundings/food.h"

namespace aquarama::world {

// A visitor drops food.
struct DropFood {
    glm::vec3 position{};  // metres, world frame
    // How many; fewer where there is no room for more.
    std::uint32_t pellets = 12;
};

// Sets position and velocity of the submarine, world frame. For stages and tests; a visitor steers
// it by Steering.
struct MoveSubmarine {
    glm::vec3 position{};
    glm::vec3 velocityMetresPerSecond{};
};

// The hall's clock says what time of day it is and how fast it goes. Without effect in a scene that
// does not follow the hall.
struct SetClock {
    double timeOfDay = 0.5;    // 0 to 1, 1 excluded
    double lengthSeconds = 0;  // of a day at this pace; 0: it stands still
};

// A fish that waits for a visitor's drawing comes in with it as its skin. Without effect on
// another.
struct EnterDrawing {
    std::uint32_t fish = 0;
    std::uint32_t number = 0;  // FishRecord::skin
    Digest picture;            // of its PNG
    int aside = 0;             // from where: -1 left, 0 middle, 1 right
};

// A fish with a drawing swims away, and waits for another. Without effect on any other.
struct LeaveDrawing {
    std::uint32_t fish = 0;
};

// The scene goes to a time of day and keeps it, or goes back to that of its clock.
struct SetDay {
    std::optional<double> timeOfDay;  // 0 to 1, 1 excluded; nothing: the clock's
    double glideSeconds = 0;          // so long it takes
};

// A hunter that patrols comes before the wall, and hunts. Without effect on other species.
struct ReleaseHunter {
    std::uint32_t species = 0;  // its place in the cast
};

// World::apply() takes it, between two ticks.
using WorldInput = std::variant<DropFood,
                                MoveSubmarine,
                                Steering,
                                SetClock,
                                WallHands,
                                EnterDrawing,
                                LeaveDrawing,
                                SetDay,
                                ReleaseHunter>;

// Counters of what happened since tick 0.
struct WorldCounts {
    // Particles of food that were eaten.
    std::uint64_t meals = 0;
    // Fish that were eaten.
    std::uint64_t catches = 0;
    std::uint64_t spawnings = 0;
    // Fish that came in place of those eaten.
    std::uint64_t returns = 0;
    // Bites of turf, puffs of sand, and charges of those that hold a territory.
    std::uint64_t bites = 0;
    std::uint64_t puffs = 0;
    std::uint64_t charges = 0;
    friend bool operator==(const WorldCounts&, const WorldCounts&) = default;
};

// Food on its way into a mouth: a fish that snaps draws it in with the water (Tu 1996, section
// 5.6.3). That takes a few ticks, in which the particle can be seen to move.

// All particles being swallowed. Owned by the world.
struct Meals {
    // One particle and the fish that swallows it.
    struct Swallow {
        std::uint32_t fish = fish::kNobody;
        std::uint32_t particle = fish::kNobody;
        std::uint32_t ticksLeft = 0;
    };
    // In the order in which they began.
    std::vector<Swallow> swallows;
};

// Reserves room for one swallow of each fish, so that none allocates later: no fish snaps again
// before it has swallowed.
[[nodiscard]] Meals makeMeals(std::size_t fish);
// Begins a swallow. The fish must have taken the particle (takeFood()).
void beginSwallow(Meals& meals, std::uint32_t fish, std::uint32_t particle);

}  // namespace aquarama::world
