// SPDX-License-Identifier: Apache-2.0
// Fish with visitors' drawings: how they come, how long they show themselves, and how they go.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "common/base/units.h"
#include "master/surroundings/surroundings.h"
#include "master/world/absences.h"
#include "master/world/events.h"
#include "master/world/fish_columns.h"

namespace aquarama::world {

// The water of a world and its species at a tick, for what puts fish into it.
struct WaterAtTick {
    const surroundings::Surroundings& surroundings;
    std::span<const fish::SpeciesParameters> speciesParameters;
    std::uint32_t seed;
    Tick tick;
};

// Puts a fish that was away into the water, level along a course, at its speed (body lengths a
// second), with a new mind.
void putIn(const WaterAtTick& water,
           std::uint32_t fish,
           glm::vec3 place,
           glm::vec3 course,
           float speed,
           FishColumns& columns);

// Where the viewer is, and which way the vessel looks, level.
void lookFrom(const surroundings::Vessel& vessel, fish::Wearers& wearers);
// How fast the viewer may travel so that those who come and show themselves keep up with it, metres
// a second.
[[nodiscard]] float fastestWith(const FishColumns& columns,
                                std::span<const fish::SpeciesParameters> speciesParameters);
// A fish that waits comes in with a drawing. Nothing happens to one that does not wait.
void enter(const WaterAtTick& water, const EnterDrawing& drawing, FishColumns& columns);
// It begins to swim away.
void leave(const LeaveDrawing& drawing, Tick tick, FishColumns& columns);
// Once a tick: who has come shows itself, who has shown itself lives, who is out of sight waits
// again.
void leadWearers(const WaterAtTick& water, FishColumns& columns, std::vector<Absence>& absences);

}  // namespace aquarama::world
