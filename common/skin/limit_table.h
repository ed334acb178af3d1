// SPDX-License-Identifier: Apache-2.0
// The surface of a species at each level of detail, as tables for the compute shaders. They are
// made once at the start, or read from the cache of derived data, and never change.
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

// Numbers the vertices of a cage whose faces are each cut into n x n pieces, so that neighbouring
// faces share the vertices on their common border. Corners of faces are the cage's own vertices,
// with the same numbers. Column i of a face is at u = i / n, row j at v = j / n.
class FaceGrid {
  public:
    // cuts: n, at least 1.
    FaceGrid(const body::ControlCage& cage, int cuts);

    // A place on a face; u and v from 0 to 1.
    struct Location {
        std::uint32_t face = 0;
        float u = 0, v = 0;
    };

    // n.
    [[nodiscard]] int cuts() const { return cuts_; }
    // The vertex of a face at column i and row j, each from 0 to n.
    [[nodiscard]] std::uint32_t at(std::size_t face, int i, int j) const;
    // For each vertex one place where it lies, ordered by vertex; those on borders have several.
    [[nodiscard]] const std::vector<Location>& locations() const { return locations_; }

  private:
    int cuts_;
    std::vector<std::uint32_t> numbers_;
    std::vector<Location> locations_;
};

// Level 0 is the control mesh itself (paper, section 6); 1 to 3 lie on the Catmull-Clark limit
// surface, at the corners of the faces that so many refinements make.
inline constexpr int kSurfaceLevels = 4;

// How much one control point contributes to the position and the two tangents of one vertex, as the
// compute shader reads it (std430).
struct StencilEntry {
    std::uint32_t controlPoint = 0;
    float position = 0;
    float tangentU = 0;
    float tangentV = 0;
};
static_assert(sizeof(StencilEntry) == 16);

// The constant data of a vertex: its place on the fish at rest. These are the skin shader's
// coordinates.
struct SkinPlace {
    glm::vec4 rest{};  // s, y, z in body lengths; w: height v, -1 belly .. +1 back
    // p along a fin's base, q from base to edge. On the body q is CageVertex::mouth.
    glm::vec2 fin{};
    std::uint32_t part = 0;  // CagePart; holds for the triangles whose last vertex this is
};
static_assert(sizeof(SkinPlace) == 28);

// The surface of a species at one level of detail: how each vertex follows from the control points,
// and its triangles.
struct LimitTable {
    // Vertex i has entries [firstEntry[i], firstEntry[i + 1]): one more element than vertices.
    std::vector<std::uint32_t> firstEntry;
    std::vector<StencilEntry> entries;
    // The first kControlPoints are those of the cage, in its order.
    std::vector<SkinPlace> vertices;
    // Counter-clockwise triangles: first the body's, which have bodyIndices indices, then the
    // fins'.
    std::vector<std::uint32_t> indices;
    std::size_t bodyIndices = 0;
    // The vertices from here on are attachments (attachments.h), the same at every level; their
    // triangles come last among the body's and the fins'.
    std::size_t skinVertices = 0;
};

// A point of the surface, in the frame of the control points.
struct SkinPoint {
    glm::vec3 position{};
    glm::vec3 normal{};  // outward
};
// A vertex of the surface for given control points: what the compute shader does, on the CPU.
[[nodiscard]] SkinPoint skinPoint(const LimitTable& table,
                                  std::size_t vertex,
                                  std::span<const glm::vec3> controlPoints);

// level: 0 to kSurfaceLevels - 1. Takes 5 to 50 ms. Throws Error where OpenSubdiv refuses the cage.
[[nodiscard]] LimitTable makeLimitTable(const body::FishBody& body, int level);

// How a level of detail refines the next coarser one, so that a mesh changes between them without a
// jump. For each vertex of makeLimitTable(body, level) it has two vertices of the same table; on
// the triangles of the coarser level the vertex lies in the middle between them. Both are the
// vertex itself where the coarser level has it too. level is at least 1; coarser is
// makeLimitTable(body, level - 1).
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> coarserParents(const body::FishBody& body,
                                                                       int level,
                                                                       const LimitTable& coarser);

}  // namespace aquarama::skin
