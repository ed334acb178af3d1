// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

namespace aquarama {

// Radians in a degree: people write degrees, code keeps radians.
template <class Real>
inline constexpr Real kRadiansPerDegree = std::numbers::pi_v<Real> / 180;

}  // namespace aquarama
