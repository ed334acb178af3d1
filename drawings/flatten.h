// SPDX-License-Identifier: Apache-2.0
// Where the places of a sheet are in a picture of it.
#pragma once

#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

namespace aquarama::drawings {

// A place on the sheet, in millimetres (layout.h), and where it was found, in pixels.
struct Correspondence {
    glm::dvec2 onSheet{}, inPhoto{};
};

// A homography.
struct Flattening {
    glm::dmat3 photoFromSheet{1.0};
    // The largest distance, on the sheet, from where a pair is to where it should be.
    double worstMillimetres = 0;

    // In pixels, of a place in millimetres.
    [[nodiscard]] glm::dvec2 photoAt(glm::dvec2 sheet) const {
        const glm::dvec3 at = photoFromSheet * glm::dvec3{sheet, 1};
        return glm::dvec2{at} / at.z;
    }
    // Pixels of the photo to a millimetre about a place: the fewest in any direction, and the most.
    [[nodiscard]] glm::dvec2 pixelsPerMillimetre(glm::dvec2 sheet) const;
};

// By the least squares of the normalised direct linear transform. At least four pairs, of which
// no three lie on one line.
[[nodiscard]] Flattening flatten(const std::vector<Correspondence>& pairs);

}  // namespace aquarama::drawings
