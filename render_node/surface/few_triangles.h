// SPDX-License-Identifier: Apache-2.0
// A fish of some forty triangles: four rings of the control cage, the nose, and a sheet for the
// tail fin and for each fin of the midline. Its corners are control points, so that it bends as the
// fish does; and every vertex of the control mesh has a place on it, out of which it grows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "common/body/fish_body.h"
#include "common/skin/limit_table.h"

namespace aquarama::surface {

struct FewTriangles {
    struct Vertex {
        skin::SkinPlace place;
        std::uint32_t controlPoint = 0;
        glm::vec3 normal{};  // of the fish at rest, body frame
    };
    // Where a vertex of the control mesh is on these triangles.
    struct Place {
        std::array<std::uint32_t, 3> controlPoints{};
        std::array<float, 3> weights{};
        glm::vec3 normal{};
        skin::SkinPlace place;  // what is painted there
    };
    std::vector<Vertex> vertices;
    std::vector<std::uint32_t> indices;  // counter-clockwise: the body's, then the fins', seen from
    std::size_t bodyIndices = 0;         // either side
    std::vector<Place> cage;             // one a vertex of the control mesh
};

// controlMesh: makeLimitTable(body, 0).
[[nodiscard]] FewTriangles makeFewTriangles(const body::FishBody& body,
                                            const skin::LimitTable& controlMesh);

}  // namespace aquarama::surface
