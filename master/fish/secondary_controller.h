// SPDX-License-Identifier: Apache-2.0
// From intention to motor command (paper, section 5.1): which action segment, how fast it plays,
// and a change of it when a fish has swum one pattern for too long.
#pragma once

#include <cstdint>
#include <vector>

#include "common/motion/motion_state.h"
#include "common/units/ids.h"
#include "master/fish/courses.h"
#include "master/fish/fish_view.h"
#include "master/fish/gaits.h"

namespace aquarama::fish {

// What the controller remembers of each fish from one decision to the next.
struct ControllerMemory {
    std::vector<std::uint64_t> chosenAt;   // tick at which the present segment was chosen
    std::vector<std::uint64_t> heldUntil;  // tick up to which a recommendation is followed
    std::vector<std::uint16_t> patience;   // ticks of one segment before another is recommended

    void resize(std::size_t fish);
};

// Commands at rest: each of fish [first, last) swims on at medium speed, with its own patience.
void startCommands(const Gaits& gaits,
                   std::uint32_t seed,
                   std::size_t first,
                   std::size_t last,
                   motion::MotorCommands& commands,
                   ControllerMemory& memory);

// Each fish has its own tempo, within 10 % of the recorded: 51 fish of one cycle would look cloned.
[[nodiscard]] float tempoOf(std::uint32_t seed, std::size_t fish);

// Commands those among fish [first, last) that think at this tick.
struct SecondaryController {
    const Gaits* gaits = nullptr;
    const FishView* view = nullptr;
    const Courses* courses = nullptr;
    const motion::MotionStates* states = nullptr;
    std::uint32_t seed = 0;
    Tick tick;
    motion::MotorCommands* commands = nullptr;
    ControllerMemory* memory = nullptr;

    void run(std::size_t first, std::size_t last) const;

    struct Moment;

  private:
    // What follows a turn begins in this tick, whoever's time it is to think.
    [[nodiscard]] bool endsTurn(std::size_t fish) const;
    void decide(std::size_t fish) const;
    [[nodiscard]] Moment momentOf(std::size_t fish) const;
    [[nodiscard]] motion::Action choose(std::size_t fish, const Moment& moment) const;
    [[nodiscard]] std::int16_t phaseRateFor(std::size_t fish,
                                            motion::Action chosen,
                                            const Moment& moment) const;
};

}  // namespace aquarama::fish
