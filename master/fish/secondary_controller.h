// SPDX-License-Identifier: Apache-2.0
// The secondary controller (paper, section 5.1): turns the course that a mind wants into a motor
// command, that is, an action segment, its phase rate and small corrections. It also changes the
// segment when a fish has swum one pattern for too long.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "common/base/units.h"
#include "common/motion/motion_state.h"
#include "common/motion/motor.h"
#include "master/fish/fish_view.h"

namespace aquarama::fish {

// A fish thinks every eighth tick (Reynolds 2006), an alarmed one every fourth, for its fast start:
// other commands change every eighth tick. Its index shifts the tick, so that an eighth of all fish
// think at each tick.
inline constexpr std::uint64_t kTicksBetweenThoughts = 8;
inline constexpr std::uint64_t kTicksOfAlarm = 4;
[[nodiscard]] constexpr bool thinksAt(Tick tick, std::size_t fish, bool isAlarmed = false) {
    return (tick.value + fish) % (isAlarmed ? kTicksOfAlarm : kTicksBetweenThoughts) == 0;
}

// What the face of a fish is to show, by its mind: MotorCommands::mouth and gaze.
struct Face {
    std::uint8_t mouth = 0, gaze = 0;
};

// The course that a mind asks of its motor: direction, speed and urgency (the motor controller
// parameters of the paper, section 5.1). Written at every thought, kept until the next.
struct Course {
    glm::vec3 direction{1, 0, 0};  // unit vector
    // Body lengths a second. Below a quarter of the slow gait's speed the fish hovers; a negative
    // speed asks for a retreat.
    float speed = 0;
    // 0 in open water; from 1 on the fish turns sharply.
    float urgency = 0;
    // Whether the fish makes a fast start, as one that is startled or that strikes.
    bool startsFast = false;
    // Whether the controller may try another swim pattern for a while. think() sets it after the
    // routine, alike for all routines.
    bool openToChange = false;
    // think() sets it after the routine, too.
    Face face = {};
};

// One for each fish of the world, by index.
using Courses = std::vector<Course>;

// Three changes of the mind that make up for a motor weaker than the biomechanical fish (paper,
// sections 5.1 and 5.2). All are on in a show; the study switches them off to measure their effect.
struct Adaptation {
    bool recommendations = true;  // another swim pattern when one was pursued for too long
    bool enlargedRegions = true;  // collision threats are felt from farther off
    bool earlierPursuit = true;   // the exact place of a target counts from farther off
};

// The numbers of a repertoire that the controller chooses by.

// The actions of one species, indexed by Action; those of a turn are of its first segment.
struct Gaits {
    // Phase rate as recorded, in 1/65536 of a cycle per tick.
    std::array<std::int16_t, motion::kActions> phaseRate{};
    // Mean speed, body lengths a second.
    std::array<float, motion::kActions> speed{};
    // Change of course from start to end of each segment, in radians, left positive.
    std::array<float, motion::kSegments> turn{};
    // Mean rate of turn, radians a second, left positive.
    std::array<float, motion::kActions> yawRate{};
    // Whether the pectoral fins row.
    std::array<bool, motion::kActions> rows{};
    // Mean rate of pitch, radians a second, up positive.
    std::array<float, motion::kActions> pitchRate{};
};
[[nodiscard]] Gaits gaitsOf(const motion::MotorTables& tables);

// The controller and its memory.

// The controller's memory of each fish from one decision to the next. Owned by the world; a thread
// writes only the elements of the fish that it controls.
struct ControllerMemory {
    // Tick at which the present segment was chosen.
    std::vector<std::uint64_t> chosenAt;
    // Tick until which a recommended segment is kept.
    std::vector<std::uint64_t> heldUntil;
    // Ticks of one segment after which another is recommended.
    std::vector<std::uint16_t> patience;
    // Tick after which the fish can make a fast start again.
    std::vector<std::uint64_t> recoversAt;

    // Gives each of so many fish an element of every column.
    void resize(std::size_t fish);
    // Memory in use.
    [[nodiscard]] std::size_t bytes() const;
};

// Initial commands of fish [first, last): medium forward gait, straight on; draws the patience of
// each fish.
void startCommands(const Gaits& gaits,
                   std::uint32_t seed,
                   std::size_t first,
                   std::size_t last,
                   motion::MotorCommands& commands,
                   ControllerMemory& memory);

// Factor on the recorded phase rates, 0.9 to 1.1, drawn for each fish: with equal tempi a school
// would look cloned.
[[nodiscard]] float tempoOf(std::uint32_t seed, std::size_t fish);

// Decides for the fish of one species that have thought at this tick. Points to columns of the
// world, owns nothing; run() may be called from several threads for disjoint ranges.
struct SecondaryController {
    const Gaits* gaits = nullptr;
    const FishView* view = nullptr;
    const Courses* courses = nullptr;
    const motion::MotionStates* states = nullptr;
    // Marks of the fish that have thought at this tick; run() takes them back.
    std::vector<std::uint8_t>* thought = nullptr;
    std::uint32_t seed = 0;
    Tick tick;
    motion::MotorCommands* commands = nullptr;
    ControllerMemory* memory = nullptr;

    // Writes commands and memory of those fish [first, last) that decide at this tick.
    void run(std::size_t first, std::size_t last) const;

    // The situation of one fish at its decision; defined in the source file.
    struct Moment;

  private:
    // Whether the fish's turn or fast start ends in this tick. Then it decides at once, also
    // between two thoughts, so that the next segment begins without a gap.
    [[nodiscard]] bool endsTurn(std::size_t fish) const;
    void decide(std::size_t fish) const;
    [[nodiscard]] bool isBursting(std::size_t fish) const;
    // Whether the command stands although another was chosen. With anything in its way a fish does
    // not break a turn off for another turn: the side from which it is pushed changes as it turns,
    // and it would turn to neither.
    [[nodiscard]] bool isKept(std::size_t fish, const Moment& moment, motion::Action asked) const;
    [[nodiscard]] Moment momentOf(std::size_t fish) const;
    [[nodiscard]] motion::Action choose(std::size_t fish, const Moment& moment) const;
    // Whether the fish is asked for a fast start and has recovered from the one before.
    [[nodiscard]] bool mayStart(std::size_t fish) const;
    // The fast start that it then makes; nothing where straight on is nearer.
    [[nodiscard]] std::optional<motion::Action> startFor(std::size_t fish) const;
    [[nodiscard]] std::int16_t phaseRateFor(std::size_t fish,
                                            motion::Action chosen,
                                            const Moment& moment) const;
};

}  // namespace aquarama::fish
