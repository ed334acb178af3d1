// SPDX-License-Identifier: Apache-2.0
// The intention of each fish: which way and how fast it wants to go, from what it sees.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "common/units/ids.h"
#include "master/behaviour/journey.h"
#include "master/behaviour/neighbour_grid.h"
#include "master/behaviour/school_view.h"
#include "master/behaviour/surroundings.h"

namespace aquarama {

// A fish thinks every eighth tick (Reynolds 2006), each in its turn.
inline constexpr std::uint64_t kTicksBetweenThoughts = 8;
[[nodiscard]] constexpr bool thinksAt(Tick tick, std::size_t fish) {
    return (tick.value + fish) % kTicksBetweenThoughts == 0;
}

struct Intentions {
    std::vector<float> directionX, directionY, directionZ;  // unit vector
    std::vector<float> speed;                               // body lengths a second
    std::vector<float> urgency;  // 0 in the open; from 1 on to avoid comes before to follow

    void resize(std::size_t fish) {
        for (auto* values : {&directionX, &directionY, &directionZ, &speed, &urgency})
            values->resize(fish);
    }
    [[nodiscard]] glm::vec3 direction(std::size_t fish) const {
        return {directionX[fish], directionY[fish], directionZ[fish]};
    }
};

// How far from its goal a school of so many fish reaches at ease.
[[nodiscard]] float schoolRadiusMetres(std::size_t fish);

// Forms the intentions of those among fish [first, last) that think at this tick: separation,
// alignment and cohesion with the nearest seen, the school's common way, and avoidance.
struct Steering {
    const SchoolView* view = nullptr;
    const NeighbourGrid* grid = nullptr;
    const Surroundings* surroundings = nullptr;
    std::size_t schoolmates = 0;  // fish [0, schoolmates) are the school
    Goal goal;
    float schoolRadius = 0;  // metres
    std::uint32_t seed = 0;
    Tick tick;
    Intentions* intentions = nullptr;

    void run(std::size_t first, std::size_t last) const;

  private:
    void think(std::size_t fish) const;
};

}  // namespace aquarama
