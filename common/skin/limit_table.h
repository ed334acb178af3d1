// SPDX-License-Identifier: Apache-2.0
// Numbers the vertices of a cage whose faces are each cut into n x n pieces, so that faces share
// those on their borders.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "common/body/fish_body.h"

namespace aquarama::skin {

// Vertex numbers of one face, row by row: column i is at u = i / n, row j at v = j / n. Corners of
// the face are the cage's own vertices.
class FaceGrid {
  public:
    FaceGrid(const body::ControlCage& cage, int cuts);

    struct Location {
        std::uint32_t face = 0;
        float u = 0, v = 0;
    };

    [[nodiscard]] int cuts() const { return cuts_; }
    [[nodiscard]] std::uint32_t at(std::size_t face, int i, int j) const;
    // For each vertex a place where it lies, ordered by vertex.
    [[nodiscard]] const std::vector<Location>& locations() const { return locations_; }

  private:
    int cuts_;
    std::vector<std::uint32_t> numbers_;
    std::vector<Location> locations_;
};

// The surface of a species at one level of detail: how each vertex follows from the control points,
// and its triangles.

// Level 0 is the control mesh itself (paper, section 6); 1 and 2 lie on the Catmull-Clark limit
// surface, at the corners of the faces that so many refinements make.
inline constexpr int kSurfaceLevels = 3;

// Weights of one control point in one vertex, as the compute shader reads them.
struct StencilEntry {
    std::uint32_t controlPoint = 0;
    float position = 0;
    float tangentU = 0;
    float tangentV = 0;
};
static_assert(sizeof(StencilEntry) == 16);

// What never changes about a vertex: where it is on the fish at rest. The skin shader's
// coordinates.
struct SkinPlace {
    glm::vec4 rest{};        // s, y, z in body lengths; w: height v, -1 belly .. +1 back
    glm::vec2 fin{};         // p along a fin's base, q from base to edge; zero on the body
    std::uint32_t part = 0;  // CagePart; holds for the triangles whose last vertex this is
};
static_assert(sizeof(SkinPlace) == 28);

struct LimitTable {
    std::vector<std::uint32_t>
        firstEntry;  // vertex i owns entries [firstEntry[i], firstEntry[i + 1])
    std::vector<StencilEntry> entries;
    std::vector<SkinPlace>
        vertices;  // the first kControlPoints are those of the cage, in its order
    std::vector<std::uint32_t>
        indices;  // counter-clockwise triangles: first the body's, then the fins'
    std::size_t bodyIndices = 0;
    // The vertices from here on are attachments (attachments.h), the same at every level; their
    // triangles come last among the body's and the fins'.
    std::size_t skinVertices = 0;
};

struct SkinPoint {
    glm::vec3 position{};
    glm::vec3 normal{};  // outward
};
// A vertex of the surface over these control points.
[[nodiscard]] SkinPoint skinPoint(const LimitTable& table,
                                  std::size_t vertex,
                                  std::span<const glm::vec3> controlPoints);

// Takes 5 to 50 ms.
[[nodiscard]] LimitTable makeLimitTable(const body::FishBody& body, int level);

// How a level of detail hangs on the next coarser one, so that a mesh may grow out of it without a
// jump.

// For each vertex of makeLimitTable(body, level) the two vertices of the same table in whose middle
// the triangles of the next coarser level have it; twice itself for those that the coarser level
// has too. level is at least 1.
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> coarserParents(const body::FishBody& body,
                                                                       int level,
                                                                       const LimitTable& coarser);

}  // namespace aquarama::skin
