// SPDX-License-Identifier: Apache-2.0
// The state of a world between two ticks, and its bytes: with the options of the world it decides
// how the world goes on, on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/base/units.h"
#include "common/motion/motion_state.h"
#include "common/place/day.h"
#include "master/fish/minds.h"
#include "master/fish/released.h"
#include "master/fish/secondary_controller.h"
#include "master/fish/wearers.h"
#include "master/surroundings/day_cue.h"
#include "master/surroundings/pilot.h"
#include "master/surroundings/surroundings.h"
#include "master/world/absences.h"
#include "master/world/events.h"

namespace aquarama::world {

// All that changes with time and is no function of options and tick. A copy into one of the same
// world allocates nothing in a steady world.
struct WorldState {
    Tick tick;
    // Of each fish.
    motion::MotionStates states;
    motion::MotorCommands commands;
    fish::Minds minds;
    fish::Courses courses;
    fish::ControllerMemory memory;
    std::vector<std::uint8_t> signs;  // FishView::signs
    std::vector<fish::Wearer> wearers;
    std::vector<fish::Released> released;
    // Of the surroundings.
    surroundings::Food food;
    std::vector<std::uint16_t> turf;  // Turf::fill
    std::vector<surroundings::Structure> structures;
    surroundings::HeldHands hands = surroundings::makeHands();
    place::DayClock clock;
    std::optional<surroundings::DayCue> dayCue;
    double timeOfDay = 0.5;
    std::uint64_t nextDrop = 0;
    surroundings::Pilot pilot;
    // Of the world as a whole.
    surroundings::Goal goal;
    Meals meals;
    std::vector<Absence> absences;
    WorldCounts counts;
};

// What the numbers of a state may name. Points into a world.
struct StateBounds {
    std::span<const fish::SpeciesParameters> species;
    const surroundings::Surroundings& surroundings;
};

// Its bytes: versions of the format, the motor and the minds, all numbers, and a SHA-256 of them.
[[nodiscard]] std::vector<std::byte> encodeState(const WorldState& state);

// A state of a world, of which `like` is any: it has as many fish, particles, patches and so on.
// Throws Error where the bytes are damaged, of other versions or of another world, or where a
// number cannot be; `source` names them in it. Allocates as much as `like` takes.
[[nodiscard]] WorldState decodeState(std::span<const std::byte> bytes,
                                     const WorldState& like,
                                     const StateBounds& bounds,
                                     const std::string& source);

}  // namespace aquarama::world
