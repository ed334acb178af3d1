// SPDX-License-Identifier: Apache-2.0
// The kinematic motor: advances fish by one tick from their repertoire, eq. 10 and 11 (paper,
// section 4).
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "common/motion/motion_state.h"
#include "common/motion/repertoire.h"
#include "common/motion/warp_plans.h"

namespace aquarama::motion {

// The tables that the step reads, made once from a repertoire by exact arithmetic (no libm), the
// same on every machine. They are immutable, so all threads may share them.
class MotorTables;
// Plans of warps take most of the time: `keep` may return those that `make` made of the same
// repertoire before, instead of calling it.
using KeepWarpPlans = std::function<WarpPlans(const std::function<WarpPlans()>& make)>;
[[nodiscard]] std::shared_ptr<const MotorTables> makeMotorTables(const Repertoire& repertoire,
                                                                 const KeepWarpPlans& keep = {});

// The way that each fish is carried in the coming tick, by the water and by contact, in units of
// 2^-16 m, by index. Its speed and what it plays are relative to the water.
struct Advection {
    std::vector<std::int32_t> x, y, z;
};

// Advances fish [first, last) of one species by one tick: new segment and motion warp where the
// command asks for one, speed, body frame by the recorded increment over the tick, commanded yaw
// and pitch, balancing roll; then rounds to integers. Bit-identical for any split into ranges, any
// compiler optimisation and any instruction set. Ranges that do not overlap may run on different
// threads.
//
// Of the nine patterns (section 3.2) these are played: swimming, turning, ascending, descending and
// retreating as recorded, and beside them fast starts and what fins do in one place; gliding by a
// warp to Action::Glide. The fins add pitch, up to kAddedPitch of the rate of the recorded climb,
// and roll that balances, and MotorCommands::brake brakes.
//
// The speed v of a fish follows that of the path, p, as SpeedResponse says; p is the recorded speed
// times the phase rate over the recorded one. Where p changes within a segment, v gains what it
// gains, and of what it loses the share v / p. Where the response is all zero, v equals p. In each
// tick the body frame moves by the path's translation and, along the mean frame's x axis, by (v -
// p) for the length of the tick. So a fish whose tail rests still coasts. A fish that is slower
// than its path, v < p, moves by the share v / p of the translation: it goes where it looks. A
// steady fish plays exactly what was recorded.
struct MotorStep {
    // All are owned by the caller and not null. traits, commands and states are indexed by fish.
    const MotorTables* tables = nullptr;
    std::span<const FishTraits> traits;
    const MotorCommands* commands = nullptr;
    MotionStates* states = nullptr;
    std::size_t first = 0;
    std::size_t last = 0;
    // Null in still water.
    const Advection* advection = nullptr;

    // Vectorised for the best instruction set of the processor, chosen at run time.
    void run() const;
    // Plain C++: what run() is tested against.
    void runReference() const;
};

// The direction of travel without the sway of the tail beat: the rotation from the cycle-mean frame
// at this fish's phase to world axes.
[[nodiscard]] glm::quat meanRotation(const MotorTables& tables,
                                     const MotionStates& states,
                                     std::size_t fish);

// The phase rate, 1/65536 of a cycle in a tick, at which a segment plays as recorded, and the body
// lengths a second it then travels.
[[nodiscard]] std::int16_t recordedPhaseRate(const MotorTables& tables, Action action);
[[nodiscard]] float recordedSpeedBodyLengths(const MotorTables& tables, Action action);
// Mean rate of turn of a segment as recorded, radians a second, left positive.
[[nodiscard]] float recordedTurnRate(const MotorTables& tables, std::uint32_t segment);
// Mean rate at which a cycle pitches the fish, radians a second, up positive.
[[nodiscard]] float recordedPitchRate(const MotorTables& tables, Action action);

// A hash of the motor's results on this machine, for a small built-in school that plays every
// action. Equal hashes mean equal motors. Takes some 0.1 s.
[[nodiscard]] std::uint64_t motorSelfTest();

// Sine of the pitch by which a fish must be off to begin a slope, and to go on with it. Less is
// corrected by the fins (MotorCommands::pitch).
inline constexpr float kSlopeFrom = 0.08F;
inline constexpr float kSlopeUntil = 0.04F;
// pitchError: of the wanted pitch less the present one, both as sines.
[[nodiscard]] inline bool takesSlope(Action present, float pitchError) {
    return std::abs(pitchError) > (pitches(present) ? kSlopeUntil : kSlopeFrom);
}
[[nodiscard]] constexpr Action slopeOf(Action gait, bool up) {
    return atGait(up ? Action::ClimbSlow : Action::DiveSlow, gait);
}

}  // namespace aquarama::motion
