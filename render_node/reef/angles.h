// SPDX-License-Identifier: Apache-2.0
// Angles that forms of the reef share, radians.
#pragma once

#include <numbers>

namespace aquarama::scene {

inline constexpr float kTwoPi = 2.0F * std::numbers::pi_v<float>;
// Steps by this angle spread parts evenly around a centre, for any number of them.
inline constexpr float kGoldenAngle = 2.39996F;

}  // namespace aquarama::scene
