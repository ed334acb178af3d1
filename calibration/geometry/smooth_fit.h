// SPDX-License-Identifier: Apache-2.0
// A smooth function over a picture that follows measured values, by least squares.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include "calibration/geometry/model.h"

namespace aquarama::geometry {

// A place (0 to 1 both ways) and two values there; weight: one over their standard deviation.
struct Measured {
    glm::dvec2 share{}, values{};
    double weight = 0;
};

// Standard deviations: of the change of slope from one control to the next, and of the values as a
// whole.
struct Smoothness {
    double bend = 0, size = 0;
};

// Two functions, of the two values.
struct FieldPair {
    SmoothField first{{1, 1}}, second{{1, 1}};
    [[nodiscard]] glm::dvec2 at(glm::dvec2 share) const {
        return {first.at(share), second.at(share)};
    }
};

// In `rounds` of weights that make little of what lies farther off than about `far`.
[[nodiscard]] FieldPair smoothFit(std::vector<Measured> measured,
                                  glm::ivec2 cells,
                                  const Smoothness& smoothness,
                                  double far,
                                  int rounds);

}  // namespace aquarama::geometry
