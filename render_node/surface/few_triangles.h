// SPDX-License-Identifier: Apache-2.0
// A fish of about forty triangles: four rings of the control cage, the nose, and a flat sheet for
// the tail fin and for each fin of the midline. Its corners are control points, so that it bends as
// the fish does. Every vertex of the control mesh has a place on it: there the vertex starts when
// the finer level fades in.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "common/body/fish_body.h"
#include "common/skin/limit_table.h"

namespace aquarama::surface {

// The mesh, without posed positions.
struct FewTriangles {
    // A corner. One control point may be several vertices, one for each part that meets there.
    struct Vertex {
        skin::SkinPlace place;
        std::uint32_t controlPoint = 0;
        // Normal of the fish at rest, body frame.
        glm::vec3 normal{};
    };
    // The place of a vertex of the control mesh on these triangles: the corners of one, weights
    // that sum to 1, and the normal there.
    struct Place {
        std::array<std::uint32_t, 3> controlPoints{};
        std::array<float, 3> weights{};
        glm::vec3 normal{};
        // The place on the skin that is painted there.
        skin::SkinPlace place;
    };
    std::vector<Vertex> vertices;
    // Counter-clockwise: first the body's, bodyIndices of them, then the fins', which are seen from
    // either side.
    std::vector<std::uint32_t> indices;
    std::size_t bodyIndices = 0;
    // One for each vertex of the control mesh.
    std::vector<Place> cage;
};

// Builds the mesh. controlMesh must be makeLimitTable(body, 0).
[[nodiscard]] FewTriangles makeFewTriangles(const body::FishBody& body,
                                            const skin::LimitTable& controlMesh);

}  // namespace aquarama::surface
