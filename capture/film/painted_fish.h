// SPDX-License-Identifier: Apache-2.0
// Draws a fish with its skin without a GPU: seen from far away, so without perspective, in plain
// light from above. Lengths are body lengths.
#pragma once

#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "capture/report/script.h"
#include "common/base/picture.h"
#include "common/body/fish_body.h"
#include "common/skin/limit_table.h"

namespace aquarama::film {

// The surface of a species and its colours.
struct PaintedSkin {
    skin::LimitTable table;
    // Of each corner of its triangles: linear albedo, and opacity.
    std::vector<glm::vec4> colours;
};

// The places of a fish's surface at one moment, in the world, and its normals.
struct PosedSurface {
    std::vector<glm::vec3> places, normals;
};

// A fish of a trace at a tick: the cage that its nodal points give, its fins moved beside it as a
// node does. The tick before tells how fast the tail drifts.
[[nodiscard]] PosedSurface surfaceAt(const body::FishBody& body,
                                     const skin::LimitTable& table,
                                     const report::Trace& trace,
                                     std::size_t tick);
// The surface moved: turned about the vertical through `from`, left positive, which comes to `to`.
[[nodiscard]] PosedSurface moved(PosedSurface surface,
                                 const glm::dvec3& from,
                                 const glm::dvec3& to,
                                 double turnRadians);

// A view from far away. Unit vectors in the world, at right angles: the paper's right, its up, and
// towards the viewer.
struct FarView {
    glm::vec3 right{1, 0, 0}, up{0, 0, -1}, towards{0, 1, 0};
    glm::vec3 centre{};  // what is shown in the middle of the paper
    float pixels = 1;    // a body length
    // On a paper of this size, in pixels.
    [[nodiscard]] glm::vec2 onPaper(glm::vec3 place, glm::ivec2 sizePixels) const;
};

// Over what the paper shows already.
void drawFish(Light& paper,
              const PaintedSkin& skin,
              const PosedSurface& surface,
              const FarView& view);
// A translucent fish of one colour with an outline.
void drawGhost(Light& paper,
               const PaintedSkin& skin,
               const PosedSurface& surface,
               const FarView& view,
               glm::vec3 colour);

}  // namespace aquarama::film
