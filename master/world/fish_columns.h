// SPDX-License-Identifier: Apache-2.0
// All that a world keeps of each fish, as columns with one element for each fish of the cast.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/base/units.h"
#include "common/motion/motion_state.h"
#include "common/motion/motor.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"
#include "master/fish/released.h"
#include "master/fish/secondary_controller.h"
#include "master/fish/wearers.h"

namespace aquarama::world {

// The fish that were put elsewhere than their motor takes them, by index, from one tick on until
// the next: they came, were eaten, or were given a drawing.
struct Placements {
    Tick since;
    std::vector<std::uint32_t> fish;

    // One more, at this tick.
    void note(std::uint32_t placed, Tick now) {
        if (now != since) fish.clear();
        since = now;
        fish.push_back(placed);
    }
};

// The columns of a world. Owned by the world; in a tick each thread writes the fish of its chunk.
struct FishColumns {
    // Makes an element in each column for each of these fish.
    explicit FishColumns(std::vector<motion::FishTraits> ofFish);

    std::vector<motion::FishTraits> traits;
    motion::MotionStates states;
    motion::MotorCommands commands;
    // Written before each step; without elements in still water.
    motion::Advection advection;
    fish::Minds minds;
    fish::Courses courses;
    fish::ControllerMemory memory;
    std::vector<std::uint8_t> thought;  // in this tick; all 0 between two ticks
    // What others see of the fish, as it was when the last tick began.
    fish::FishView view;
    // Those that wear visitors' drawings, or wait for them.
    fish::Wearers wearers;
    // Hunters that a cue has released, and that are on their way.
    fish::ReleasedHunters released;
    Placements placements;
    // Predators that began to rush at the last tick, by index.
    std::vector<std::uint32_t> rushes;

    // Moves all that is noted by its tick back by so many ticks, to tick 0 at the earliest.
    void shiftTime(std::uint64_t ticks);
    // Hash of all that decides how the fish go on, and of the tick.
    [[nodiscard]] std::uint64_t hash(Tick tick) const;
    // Memory in use.
    [[nodiscard]] std::size_t bytes() const;
};

}  // namespace aquarama::world
