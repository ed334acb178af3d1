// SPDX-License-Identifier: Apache-2.0
// The kinematic motor: one tick of every fish from its repertoire, eq. 10 and 11 (paper, section
// 4).
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "common/motion/motion_state.h"
#include "common/motion/repertoire.h"

namespace aquarama::motion {

// The tables that the step reads, made once from a repertoire by exact arithmetic (no libm), the
// same on every machine.
class MotorTables;
[[nodiscard]] std::shared_ptr<const MotorTables> makeMotorTables(const Repertoire& repertoire);

// Advances fish [first, last) of one species by one tick: new segment and motion warp where the
// command asks for one, speed, body frame by the recorded increment over the tick, commanded yaw
// and pitch, balancing roll; then rounds to integers. Bit-identical for any split into ranges, any
// compiler optimisation and any instruction set.
//
// Of the nine patterns (section 3.2) these are played: swimming and turning as recorded; ascending
// and descending by commanded pitch; balancing by roll; gliding by a warp to Action::Glide;
// retreating by a negative phase rate; braking by MotorCommands::brake. The speed v of a fish goes
// after the path's, p, which is the recorded speed times the phase rate over the recorded one,
// as SpeedResponse says. While a turn plays, v changes besides as p does. Where the response is all
// zero, v follows p at once. Each tick the body frame goes by the path's translation and, along the
// mean frame's x axis, by (v - p) a tick: added, not scaled, so that a fish whose tail rests still
// coasts and the sway stays that of the pose; a steady fish plays exactly what was recorded.
struct MotorStep {
    const MotorTables* tables = nullptr;
    std::span<const FishTraits> traits;
    const MotorCommands* commands = nullptr;
    MotionStates* states = nullptr;
    std::size_t first = 0;
    std::size_t last = 0;

    void run() const;           // vectorised, by run-time dispatch
    void runReference() const;  // plain C++: what run() is held against
};

// The direction of travel, which the tail beat does not sway: the cycle-mean frame at this phase,
// in world axes.
[[nodiscard]] glm::quat meanRotation(const MotorTables& tables,
                                     const MotionStates& states,
                                     std::size_t fish);

// Phase units a tick at which a segment plays as recorded, and the body lengths a second it then
// travels.
[[nodiscard]] std::int16_t recordedPhaseRate(const MotorTables& tables, Action action);
[[nodiscard]] float recordedSpeedBodyLengths(const MotorTables& tables, Action action);
// Mean rate of turn as recorded, radians a second, left positive.
[[nodiscard]] float recordedTurnRate(const MotorTables& tables, Action action);

}  // namespace aquarama::motion
