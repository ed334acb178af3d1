// SPDX-License-Identifier: Apache-2.0
// How the fish of a scene move on in a tick: by what their minds have commanded, carried by the
// water, kept off rocks and sand. The same to the bit on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "common/base/worker_pool.h"
#include "common/motion/motor.h"
#include "common/place/current.h"
#include "common/place/obstacles.h"
#include "common/school/school_state.h"

namespace aquarama::school {

// What carries fish at a tick. `open`: the current far from boulders, metres a second. All is owned
// by the caller.
struct Carrier {
    const place::Obstacles* obstacles = nullptr;
    const place::Current* current = nullptr;
    glm::vec3 open{};

    // Writes the way that water and contact carry fish [first, last) in a tick, from where they
    // are. Fish that are away rest. Threads may write ranges that do not overlap.
    void carry(std::span<const motion::FishTraits> traits,
               const motion::MotionStates& states,
               std::size_t first,
               std::size_t last,
               motion::Advection& advection) const;
};

// The fish [first, last) of one species.
struct Swimmers {
    std::shared_ptr<const motion::MotorTables> tables;
    std::size_t first = 0, last = 0;
};

// Moves all fish of a scene. One thread uses it; its pool shares out the work of a large school.
class SchoolMotion {
  public:
    // `swimmers`: by species, one after the other; fish of none stay where they are put.
    SchoolMotion(std::vector<Swimmers> swimmers,
                 std::vector<motion::FishTraits> traits,
                 place::Obstacles obstacles,
                 const config::SceneCurrent& current);

    // Number of fish.
    [[nodiscard]] std::size_t fish() const { return traits_.size(); }
    // One tick. The commands are those of the tick; who is placed in it is set afterwards.
    void advance(SchoolState& school);
    // What fish do that nobody leads. Onward: each goes on as it was told, but ends turns, and
    // climbs and dives once it has its pitch. InCircles: each that swims goes slowly in a wide
    // level circle, to the side where it has more room. Those that hover stay where they are.
    enum class Alone : std::uint8_t { Onward, InCircles };
    // Commands all fish so; a few times a second. Not in the tick of a master.
    void command(SchoolState& school, Alone way) const;

  private:
    std::vector<Swimmers> chunks_;  // small enough to share out
    std::vector<motion::FishTraits> traits_;
    place::Obstacles obstacles_;
    place::Current current_;
    motion::Advection advection_;
    WorkerPool pool_;
};

}  // namespace aquarama::school
