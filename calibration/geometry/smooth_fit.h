// SPDX-License-Identifier: Apache-2.0
// Fits a smooth function over a picture to measured values, by least squares.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include "calibration/geometry/model.h"

namespace aquarama::geometry {

// Two values measured at a place (0 to 1 both ways); the weight is one over their standard
// deviation.
struct Measured {
    glm::dvec2 share{}, values{};
    double weight = 0;
};

// Standard deviations of the change of slope between neighbouring controls, and of the values.
struct Smoothness {
    double bend = 0, size = 0;
};

// The functions of the first and of the second value.
struct FieldPair {
    SmoothField first{{1, 1}}, second{{1, 1}};
    // The correction at a place, as shares of the picture.
    [[nodiscard]] glm::dvec2 at(glm::dvec2 share) const {
        return {first.at(share), second.at(share)};
    }
};

// Repeats the fit in `rounds`; values that lie farther off than about `far` get little weight.
[[nodiscard]] FieldPair smoothFit(std::vector<Measured> measured,
                                  glm::ivec2 cells,
                                  const Smoothness& smoothness,
                                  double far,
                                  int rounds);

}  // namespace aquarama::geometry
