// SPDX-License-Identifier: Apache-2.0
// A species as a colouring sheet shows it: its shape at rest from the right side, and a few lines.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include "common/body/side_view.h"
#include "common/config/species.h"
#include "drawings/raster.h"

namespace aquarama::drawings {

// Pixels of a likeness's raster to a texel of the skin, each way.
inline constexpr int kPixelsPerTexel = 2;

// The lines in texels of the skin (side_view.h).
struct Likeness {
    body::SideView view;
    Raster shape{kPixelsPerTexel * body::kSideTexels};  // what a skin covers
    std::vector<Polyline> outline;                      // closed, around the shape
    std::vector<Polyline> lines;                        // open: fins, rays, mouth, gill
    glm::vec2 eye{};
    float eyeRadius = 0;
};

// Of the limit surface at its finest level. Takes a tenth of a second. Throws Error where
// OpenSubdiv refuses the cage.
[[nodiscard]] Likeness likenessOf(const config::Species& species);

// The share of a texel that the shape covers, 0 to 1.
[[nodiscard]] float coverage(const Likeness& likeness, glm::ivec2 texel);

}  // namespace aquarama::drawings
