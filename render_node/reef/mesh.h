// SPDX-License-Identifier: Apache-2.0
// Meshes of the place: rock, coral, plants, sand. They are built once. Prototypes have a frame of
// their own (y up, the foot at the origin); sand is in world metres.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/gtc/type_precision.hpp>
#include <glm/vec3.hpp>

#include "common/place/place.h"

namespace aquarama::scene {

// A vertex as instance.glsl and floor.vert read it, 24 bytes.
struct SolidVertex {
    glm::vec3 position{};
    // Unit normal in 127ths; w: roughness, 0 smooth to 127 bare rock.
    glm::i8vec4 normal{};
    // Albedo in 255ths, of which a half stands for the tint; w: ambient occlusion.
    glm::u8vec4 albedo{};
    // In 255ths: share of the sway, translucency, fluorescence, relief.
    glm::u8vec4 response{};
};
static_assert(sizeof(SolidVertex) == 24);

// Where a vertex is on the next coarser level, into which its own level fades (fade.h), 20 bytes.
// Members as of SolidVertex.
struct CoarseVertex {
    glm::vec3 position{};
    glm::i8vec4 normal{};
    glm::u8vec4 albedo{};
};
static_assert(sizeof(CoarseVertex) == 20);

// A grid of vertices, which joinRows() has joined. A part of a thing has the same key at all
// levels.
struct Patch {
    std::uint32_t key = 0;
    // Index of its first vertex; the others follow row by row.
    std::uint32_t first = 0;
    int rows = 0;
    int columns = 0;
};

// Triangles, counter-clockwise as seen from outside; three indices each.
struct Mesh {
    std::vector<SolidVertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<Patch> patches;
    // Key of the patch that joinRows() adds next; it counts up.
    std::uint32_t nextKey = 0;
    // One for each vertex of a thing that has levels; else empty.
    std::vector<CoarseVertex> coarse;
};

// Levels of detail of one thing, the finest first.
inline constexpr std::size_t kLevels = 5;
using Levels = std::array<Mesh, kLevels>;

// The material at a vertex; shares are 0 to 1.
struct Surface {
    glm::vec3 albedo{0.5F};
    float roughness = 0.0F;
    // Share of the light that passes through. A high value marks a leaf, which is lit on the side
    // that faces the eye.
    float translucency = 0.0F;
    float fluorescence = 0.0F;
    // 0: polyps, to 1: the meanders of a brain coral.
    float relief = 0.0F;
    // Height at which it is fixed to a bending stem, as a share of the stem's height.
    float sway = 0.0F;
};

// Appends a vertex in packed form and returns its index.
std::uint32_t addVertex(Mesh& mesh,
                        glm::vec3 position,
                        glm::vec3 normal,
                        const Surface& surface,
                        float ambientOcclusion);
// Appends the triangles a b c and a c d.
void addQuad(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);
// Joins rows of equal length by quads, as a patch. The vertices must have been added row by row,
// from `first` on.
void joinRows(Mesh& mesh, std::uint32_t first, int rows, int columns);
// Reverses the orientation of the triangles from `firstIndex` on.
void turnOver(Mesh& mesh, std::size_t firstIndex);
// For each vertex from `first` on, the index (relative to `first`) of the first vertex at exactly
// the same place. The faces on either side of a seam have vertices of their own.
[[nodiscard]] std::vector<std::uint32_t> seamsOf(const Mesh& mesh, std::uint32_t first = 0);
// Sets area-weighted normals of all vertices from `first` on, by the triangles from `firstIndex`
// on. Vertices at one place get the same normal.
void setSmoothNormals(Mesh& mesh, std::uint32_t first, std::size_t firstIndex);

// How much of the sun and of the light from above boulders take away. Computed once, as neither the
// sun nor the rocks move.

// 0 is dark, 1 is open. Boulders count as balls; edges are soft, as the sun's light is already
// spread by the water. Cost: a step for each rock.
[[nodiscard]] float sunVisibility(std::span<const place::Rock> rocks, glm::vec3 place);
[[nodiscard]] float ambientOcclusion(std::span<const place::Rock> rocks,
                                     glm::vec3 place,
                                     glm::vec3 normal);

// Darkens a rock's mesh by the other rocks. The rock's own hollows are already in its baked ambient
// occlusion.
void shade(Mesh& mesh, std::span<const place::Rock> others);

// The shapes of rock: worn limestone with ledges, undercuts and hollows, within the unit ball.

// Number of shapes.
inline constexpr int kRockShapes = 12;

// Makes one shape at all levels, the same on every machine. It lies within the unit ball. y is up:
// a rock may be turned about y, so that its ledges stay level. Coarser levels are smoothed, so that
// they have no corners that the stone has not. The albedo of a vertex holds lightness, amount of
// turf and amount of pink crust. shape: 0 to kRockShapes - 1.
[[nodiscard]] Levels growRock(int shape);

// The spots of a shape on which something may grow: places and normals, spread evenly over its
// surface.
[[nodiscard]] Mesh rockBed(int shape);

}  // namespace aquarama::scene
