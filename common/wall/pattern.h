// SPDX-License-Identifier: Apache-2.0
// Test patterns as pure functions of the direction from the wall's origin. The render node's shader
// computes the same formulas, and the tests compare its pictures with these.
#pragma once

#include <cmath>

#include <glm/vec3.hpp>

namespace aquarama::wall {

// Lines of equal azimuth and elevation, for geometry; or an even grey, for the blend.
enum class TestPattern { Grid, Grey };

// Linear light; 1 is full white.
inline constexpr double kGreyLight = 0.18;
// The grid: spacing of lines and of bright lines in degrees, light of the others (bright ones are
// 1), and the width of a line. A line is a Gaussian: it has no edge, so there is no aliasing.
inline constexpr double kGridDegrees = 5;
inline constexpr double kGridMajorDegrees = 30;
inline constexpr double kGridMinorLight = 0.4;
inline constexpr double kGridSigmaDegrees = 0.1;

namespace pattern {

// Angle of (x, y) from the x axis.
[[nodiscard]] inline double degrees(double y, double x) {
    return std::atan2(y, x) * 57.29577951308232;
}

// Light at an angle, of lines at all multiples of the spacing.
// `scale`: of a degree of this angle, as an arc.
[[nodiscard]] inline double lines(double atDegrees, double spacingDegrees, double scale) {
    const double off =
        scale * (atDegrees - spacingDegrees * std::round(atDegrees / spacingDegrees));
    return std::exp(-off * off / (2 * kGridSigmaDegrees * kGridSigmaDegrees));
}

// The light of major and minor lines of a grid at an angle.
[[nodiscard]] inline double majorAndMinor(double atDegrees, double scale) {
    return std::fmax(kGridMinorLight * pattern::lines(atDegrees, kGridDegrees, scale),
                     pattern::lines(atDegrees, kGridMajorDegrees, scale));
}

}  // namespace pattern

// On an upright cylinder about the origin: upright lines and horizontal rings. direction: wall
// frame, of any length. isAround: what shows zenith or nadir, where lines of equal azimuth meet,
// has them as wide there as elsewhere (PatternGround::isAround).
[[nodiscard]] inline double gridLight(glm::dvec3 direction, bool isAround = false) {
    const double azimuth = pattern::degrees(direction.x, -direction.z);
    const double level = std::sqrt(direction.x * direction.x + direction.z * direction.z);
    const double elevation = pattern::degrees(direction.y, level);
    const double scale =
        isAround ? level / std::sqrt(level * level + direction.y * direction.y) : 1;
    return std::fmax(pattern::majorAndMinor(azimuth, scale), pattern::majorAndMinor(elevation, 1));
}

// The light of a test pattern at a place.
[[nodiscard]] inline double patternLight(TestPattern pattern,
                                         glm::dvec3 direction,
                                         bool isAround = false) {
    return pattern == TestPattern::Grid ? gridLight(direction, isAround) : kGreyLight;
}

}  // namespace aquarama::wall
