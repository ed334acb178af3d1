// SPDX-License-Identifier: Apache-2.0
// Draws a species' limit surface without a GPU, for documents: seen from far away, lit from above.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/base/picture.h"
#include "common/body/fish_body.h"
#include "common/config/species.h"
#include "common/skin/limit_table.h"

namespace aquarama::test {

// Directions in the frame of the nodal points: the paper's right, its up, and towards the viewer.
struct View {
    glm::vec3 right, up, towards;
};
inline constexpr View kFromTheRight{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
inline constexpr View kFromAbove{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}};
inline constexpr View kFromTheFront{{0, 0, -1}, {0, 1, 0}, {1, 0, 0}};

class Portrait {
  public:
    // The surface that these nodal points give. Colours are the palette's back, flank, belly, fin,
    // tail and iris; throws Error when one is missing.
    Portrait(const config::Species& species,
             const body::FishBody& body,
             const body::NodalPoints& nodes);

    // The least and the greatest place on the paper, y down, in body lengths.
    struct Extent {
        glm::vec2 least, most;
    };
    [[nodiscard]] Extent extent(const View& view) const;

    // Over what the paper shows already, with the origin of the nodal points' frame at a pixel.
    void draw(Light& paper,
              const View& view,
              glm::vec2 originPixels,
              float pixelsPerBodyLength) const;

  private:
    struct Vertex {
        glm::vec3 position, normal;
    };
    struct Palette {
        glm::vec3 back, flank, belly, fin, tail, iris;
    };
    [[nodiscard]] glm::vec3 colourOf(std::uint32_t part, const skin::SkinPlace& place) const;

    Palette palette_;
    glm::vec3 eye_;
    skin::LimitTable table_;
    std::vector<Vertex> vertices_;
};

}  // namespace aquarama::test
