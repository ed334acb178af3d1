// SPDX-License-Identifier: Apache-2.0
// Eyes and threads that are bound to the cage, and the coordinates of the skin shader. Lengths in
// body lengths; rest positions are (s, y, z) as in body::CageVertex.
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

// Binds places beside the cage to the body: each is a weighted sum of four control points near a
// station, and moves with them as an affine frame does.
class RestBinding {
  public:
    // cage: at rest. Uses the rings next to the one nearest to the station.
    RestBinding(const body::ControlCage& cage, float station);

    // Four control points and their weights.
    using Points = std::array<std::uint32_t, 4>;
    using Weights = std::array<float, 4>;
    // Numbers of the control points that the weights belong to.
    [[nodiscard]] const Points& points() const { return points_; }
    // Of a rest position; the weights sum to 1.
    [[nodiscard]] Weights ofPlace(glm::vec3 rest) const;
    // Of a difference of rest positions; the weights sum to 0.
    [[nodiscard]] Weights ofDirection(glm::vec3 direction) const;

  private:
    Points points_{};
    glm::mat4 weightsFromRest_{1.0F};
};

// Parts that are too small for the cage: eyes, as balls that are set into the head, whips, lone
// spines and barbels. They are bound to the cage, drawn with the skin, and the same at every level
// of detail.
struct Attachments {
    // A vertex of such a part.
    struct Vertex {
        std::vector<StencilEntry> entries;  // in the form of a surface's vertex
        // Without the height on the body (rest.w), which makeLimitTable() fills in.
        SkinPlace place;
    };
    std::vector<Vertex> vertices;
    // Triangles of these vertices, numbered from 0: drawn with the body and with the fins. Both are
    // even in number, two to a quad.
    std::vector<std::array<std::uint32_t, 3>> onBody, onFins;
};

// Corners at rest.
using RestTriangle = std::array<glm::vec3, 3>;

// head: the triangles of the skin of the head's right side, around the eye.
[[nodiscard]] Attachments makeAttachments(const body::FishBody& body,
                                          std::span<const RestTriangle> head);

// The number of pieces that a thread is cut into from root to tip; each is a tube of four sides.
[[nodiscard]] std::size_t threadSteps(const body::BodyThread& thread);

// Height of a rest position (s, y): -1 on the belly, 1 on the back, as SkinPlace::rest has it in w.
[[nodiscard]] float heightOnBody(const body::FishBody& body, float s, float y);

// Fills vertices, indices and bodyIndices of a table whose stencils are made; grid is the one they
// were made for.
void paintPlaces(const body::FishBody& body, const FaceGrid& grid, LimitTable& table);

}  // namespace aquarama::skin
