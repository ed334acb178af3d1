// SPDX-License-Identifier: Apache-2.0
// What a repertoire can do, in the numbers by which the secondary controller chooses.
#pragma once

#include <array>
#include <cstdint>

#include "common/motion/motor.h"

namespace aquarama::fish {

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

}  // namespace aquarama::fish
