// SPDX-License-Identifier: Apache-2.0
// A sheet that a program has coloured with crayons.
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/base/picture.h"
#include "drawings/sheet.h"

namespace aquarama::test {

// What the paper sends back of white light, which is linear; white paper is 1.
struct PaintedSheet {
    Light paper;
    double pixelsPerMillimetre = 1;

    // At a place of the sheet, millimetres (layout.h). Beyond the paper its border goes on.
    [[nodiscard]] glm::vec3 at(glm::dvec2 sheet) const;
    [[nodiscard]] bool isPaper(glm::dvec2 sheet) const;
};

// The sheet's own PDF, drawn by pdftoppm of poppler-utils.
[[nodiscard]] PaintedSheet printed(const drawings::Sheet& sheet, glm::dvec2 paperMillimetres);

// With strokes of three to five crayons, over the outline here and there.
[[nodiscard]] PaintedSheet painted(const drawings::Sheet& sheet,
                                   PaintedSheet paper,
                                   std::uint32_t seed);

// Noise of unit cells, 0 to 1, the same for the same place and seed.
[[nodiscard]] float smoothNoise(glm::dvec2 at, std::uint32_t seed);

}  // namespace aquarama::test
