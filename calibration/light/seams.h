// SPDX-License-Identifier: Apache-2.0
// Measures how even the light and colour of a wall are, by the truth of a simulated hall.
#pragma once

#include <span>
#include <vector>

#include "calibration/hall/drawn_wall.h"
#include "calibration/hall/true_hall.h"

namespace aquarama::light {

// One point of a profile along the wall.
struct ProfilePoint {
    double luminance = 0;
    bool isShared = false;  // by several channels
};

// The largest step of luminance in and near parts that several channels light, as a share: the
// deviation from a smooth curve through an eighth of the profile around it. The profile is a line
// of points at equal distances without gaps. 0 where nothing is shared.
[[nodiscard]] double seamOf(std::span<const ProfilePoint> profile);

// CIEDE2000 of two colours in linear Rec. 709, for an eye that takes `white` for white.
[[nodiscard]] double colourDifference(glm::dvec3 one, glm::dvec3 other, glm::dvec3 white);

// The steps of light and colour at the overlaps of a wall.
struct Seams {
    // Shares, the largest of all profiles, for white of 2, 18 and 100 %.
    double grey2 = 0, grey18 = 0, grey100 = 0;
    // CIEDE2000 from the middle of an overlap to both sides of it, in the mean of grey, red, green
    // and blue; without the slow change of white's luminance.
    double colour = 0;
};

// Measures the seams of even light on some rows and columns of the screen. Takes seconds; uses all
// processors.
[[nodiscard]] Seams seamsOf(const hall::TrueHall& truth, const hall::DrawnWall& wall);

}  // namespace aquarama::light
