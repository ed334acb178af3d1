// SPDX-License-Identifier: Apache-2.0
// Marks: strips of dark tape on a screen that show a camera the middle of its edges. Wall frame,
// metres.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

#include "common/config/rig.h"
#include "common/wall/surface.h"

namespace aquarama::wall {

// A strip of common tape, from the edge of the screen inwards.
inline constexpr double kMarkWidthMetres = 0.05, kMarkLengthMetres = 0.15;

// The place of a strip.
struct MarkPlace {
    glm::dvec3 edge{};              // the middle of its end at the screen's edge
    glm::dvec3 inwards{}, along{};  // into the screen, and across the strip; of length one
    // A point of the strip, as far as the screen is flat there.
    [[nodiscard]] glm::dvec3 at(double inwardsMetres, double alongMetres) const {
        return edge + inwardsMetres * inwards + alongMetres * along;
    }
    // Whether a strip, moved along the edge, covers a point of the screen or is nearer to it than a
    // margin.
    [[nodiscard]] bool covers(glm::dvec3 point, double movedMetres, double marginMetres) const;
};

// The places of marks: the middle of the panorama's upper and lower edge, on screens with four
// edges and on domes (back and front). None on other screens.
[[nodiscard]] std::vector<MarkPlace> markPlaces(config::ScreenShape shape,
                                                const ScreenSurface& screen);

}  // namespace aquarama::wall
