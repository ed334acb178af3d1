// SPDX-License-Identifier: Apache-2.0
// Places beside the cage as weighted sums of four control points of the body, which take them
// along.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "common/body/fish_body.h"
#include "common/skin/limit_table.h"

namespace aquarama::skin {

// The part of the body about a station, as an affine frame.
class RestBinding {
  public:
    RestBinding(const body::ControlCage& cage, float station);

    using Points = std::array<std::uint32_t, 4>;
    using Weights = std::array<float, 4>;
    [[nodiscard]] const Points& points() const { return points_; }
    [[nodiscard]] Weights ofPlace(glm::vec3 rest) const;           // they sum to 1
    [[nodiscard]] Weights ofDirection(glm::vec3 direction) const;  // they sum to 0

  private:
    Points points_{};
    glm::mat4 weightsFromRest_{1.0F};
};

// What the cage has no room for, bound to it and drawn with the skin: eyes as balls that are set
// into the head, whips, lone spines and barbels. The same at every level of detail.

struct Attachments {
    struct Vertex {
        std::vector<StencilEntry> entries;  // as a vertex of the surface has them
        SkinPlace place;                    // v is not yet known
    };
    std::vector<Vertex> vertices;
    // Of these vertices, an even number each: with the body, and with the fins.
    std::vector<std::array<std::uint32_t, 3>> onBody, onFins;
};

using RestTriangle = std::array<glm::vec3, 3>;  // (s, y, z)

// head: the skin of its right side, where the eye is.
[[nodiscard]] Attachments makeAttachments(const body::FishBody& body,
                                          std::span<const RestTriangle> head);

// Into so many pieces a thread is cut from root to tip; each is a tube of four sides.
[[nodiscard]] std::size_t threadSteps(const body::BodyThread& thread);

// Where each vertex and triangle of the surface is on the fish: the skin shader's coordinates.

// Height of a place at rest: -1 on the belly .. +1 on the back, as SkinPlace has it.
[[nodiscard]] float heightOnBody(const body::FishBody& body, float s, float y);

// Fills vertices, indices and bodyIndices of a table whose stencils are made.
void paintPlaces(const body::FishBody& body, const FaceGrid& grid, LimitTable& table);

}  // namespace aquarama::skin
