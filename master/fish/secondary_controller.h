// SPDX-License-Identifier: Apache-2.0
// What each fish's mind asks of its motor: which way it wants to go, how fast and how urgently
// (the motor controller parameters of the paper, section 5.1).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "common/motion/motion_state.h"
#include "common/motion/motor.h"
#include "common/units/units.h"
#include "master/fish/fish_view.h"

namespace aquarama::fish {

// A fish thinks every eighth tick (Reynolds 2006), each in its turn.
inline constexpr std::uint64_t kTicksBetweenThoughts = 8;
[[nodiscard]] constexpr bool thinksAt(Tick tick, std::size_t fish) {
    return (tick.value + fish) % kTicksBetweenThoughts == 0;
}

struct Course {
    glm::vec3 direction{1, 0, 0};  // unit vector
    float speed = 0;               // body lengths a second; under a quarter of slow: hover
    float urgency = 0;             // 0 in the open; from 1 on it turns sharply
    // Whether another swim pattern for a while is welcome; set for all routines alike, after them.
    bool openToChange = false;
};

using Courses = std::vector<Course>;  // of all fish

// How the mind makes up for a motor that is weaker than the biomechanical fish (paper, sections 5.1
// and 5.2). All are on in the show; a study takes each away to see what it gives.

struct Adaptation {
    bool recommendations = true;  // another swim pattern when one was pursued for too long
    bool enlargedRegions = true;  // collision threats are felt from farther off
    bool earlierPursuit = true;   // careful steering begins farther from a target
};

// What a repertoire can do, in the numbers by which the secondary controller chooses.

// Indexed by Action.
struct Gaits {
    std::array<std::int16_t, motion::kActions>
        phaseRate{};                              // as recorded, 1/65536 of a cycle in a tick
    std::array<float, motion::kActions> speed{};  // body lengths a second
    std::array<float, motion::kActions> turn{};   // radians from start to end, left positive
};
[[nodiscard]] Gaits gaitsOf(const motion::MotorTables& tables);

[[nodiscard]] constexpr std::size_t indexOf(motion::Action action) {
    return static_cast<std::size_t>(action);
}
[[nodiscard]] constexpr bool isForward(motion::Action action) {
    return action <= motion::Action::ForwardFast;
}
// Played from the first phase to the last.
[[nodiscard]] constexpr bool isTurn(motion::Action action) {
    return action >= motion::Action::TurnLeftGradual && action <= motion::Action::TurnRightSharp;
}
[[nodiscard]] constexpr bool isSharp(motion::Action action) {
    return action == motion::Action::TurnLeftSharp || action == motion::Action::TurnRightSharp;
}
[[nodiscard]] constexpr bool isLeft(motion::Action action) {
    return action == motion::Action::TurnLeftGradual || action == motion::Action::TurnLeftSharp;
}

// From intention to motor command (paper, section 5.1): which action segment, how fast it plays,
// and a change of it when a fish has swum one pattern for too long.

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
