// SPDX-License-Identifier: Apache-2.0
// What a repertoire can do, in the numbers by which the secondary controller chooses.
#pragma once

#include <array>
#include <cstdint>

#include "common/motion/motor.h"

namespace aquarama {

// Indexed by Action.
struct Gaits {
    std::array<std::int16_t, kActions> phaseRate{};  // as recorded, 1/65536 of a cycle in a tick
    std::array<float, kActions> speed{};             // body lengths a second
    std::array<float, kActions> turn{};              // radians from start to end, left positive
};
[[nodiscard]] Gaits gaitsOf(const MotorTables& tables);

[[nodiscard]] constexpr std::size_t indexOf(Action action) {
    return static_cast<std::size_t>(action);
}
[[nodiscard]] constexpr bool isForward(Action action) {
    return action <= Action::ForwardFast;
}
// Played from the first phase to the last.
[[nodiscard]] constexpr bool isTurn(Action action) {
    return action >= Action::TurnLeftGradual && action <= Action::TurnRightSharp;
}
[[nodiscard]] constexpr bool isSharp(Action action) {
    return action == Action::TurnLeftSharp || action == Action::TurnRightSharp;
}
[[nodiscard]] constexpr bool isLeft(Action action) {
    return action == Action::TurnLeftGradual || action == Action::TurnLeftSharp;
}

}  // namespace aquarama
