// SPDX-License-Identifier: Apache-2.0
// The kinematic motor: one tick of every fish from its repertoire, eq. 10 and 11 (paper, section
// 4).
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "common/motion/motion_state.h"
#include "common/motion/repertoire.h"

namespace aquarama {

// The tables that the step reads, made once from a repertoire by exact arithmetic (no libm), the
// same on every machine.
class MotorTables;
[[nodiscard]] std::shared_ptr<const MotorTables> makeMotorTables(const Repertoire& repertoire);

// Advances fish [first, last) of one species by one tick: new segment and motion warp where the
// command asks for one, body frame by the recorded increment over the tick, commanded yaw and
// pitch, balancing roll; then rounds to integers. Bit-identical for any split into ranges, any
// compiler optimisation and any instruction set.
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
[[nodiscard]] std::uint16_t recordedPhaseRate(const MotorTables& tables, Action action);
[[nodiscard]] float recordedSpeedBodyLengths(const MotorTables& tables, Action action);
// Mean rate of turn as recorded, radians a second, left positive.
[[nodiscard]] float recordedTurnRate(const MotorTables& tables, Action action);

}  // namespace aquarama
