// SPDX-License-Identifier: Apache-2.0
// Degrees, as people write angles into files, to and from radians, as the code keeps them.
#pragma once

#include <cmath>
#include <initializer_list>
#include <limits>

#include "common/units/units.h"

namespace aquarama::config {

[[nodiscard]] inline double radiansOf(double degrees) {
    return degrees * kRadiansPerDegree<double>;
}

// The degrees that radiansOf turns back into exactly these radians, so that a rig survives being
// written and read; a rounded one ("40", not "39.999999999999993") where that does.
[[nodiscard]] inline double degreesOf(double radians) {
    const double degrees = radians / kRadiansPerDegree<double>;
    const double rounded = std::round(degrees * 1e9) / 1e9;
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (const double candidate : {rounded,
                                   degrees,
                                   std::nextafter(degrees, kInfinity),
                                   std::nextafter(degrees, -kInfinity)})
        if (radiansOf(candidate) == radians) return candidate;
    return degrees;
}

}  // namespace aquarama::config
