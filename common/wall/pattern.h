// SPDX-License-Identifier: Apache-2.0
// Test patterns of the world as pure functions of the direction from the wall's origin: the render
// node's shader computes the same formulas.
#pragma once

#include <cmath>

#include <glm/vec3.hpp>

namespace aquarama::wall {

enum class TestPattern { Grid, Grey };

inline constexpr double kGreyLight = 0.18;        // linear
inline constexpr double kGridDegrees = 5;         // between lines
inline constexpr double kGridMajorDegrees = 30;   // between bright lines
inline constexpr double kGridMinorLight = 0.4;    // of the others; bright ones are 1
inline constexpr double kGridSigmaDegrees = 0.1;  // a line is a Gaussian: no edge, no aliasing

namespace pattern {

[[nodiscard]] inline double degrees(double y, double x) {
    return std::atan2(y, x) * 57.29577951308232;
}

[[nodiscard]] inline double lines(double atDegrees, double spacingDegrees) {
    const double off = atDegrees - spacingDegrees * std::round(atDegrees / spacingDegrees);
    return std::exp(-off * off / (2 * kGridSigmaDegrees * kGridSigmaDegrees));
}

[[nodiscard]] inline double majorAndMinor(double atDegrees) {
    return std::fmax(kGridMinorLight * pattern::lines(atDegrees, kGridDegrees),
                     pattern::lines(atDegrees, kGridMajorDegrees));
}

}  // namespace pattern

// Lines of equal azimuth and of equal elevation: upright lines and rings on an upright cylinder.
[[nodiscard]] inline double gridLight(glm::dvec3 direction) {
    const double azimuth = pattern::degrees(direction.x, -direction.z);
    const double level = std::sqrt(direction.x * direction.x + direction.z * direction.z);
    const double elevation = pattern::degrees(direction.y, level);
    return std::fmax(pattern::majorAndMinor(azimuth), pattern::majorAndMinor(elevation));
}

[[nodiscard]] inline double patternLight(TestPattern pattern, glm::dvec3 direction) {
    return pattern == TestPattern::Grid ? gridLight(direction) : kGreyLight;
}

}  // namespace aquarama::wall
