// SPDX-License-Identifier: Apache-2.0
// Triangles of what the place is made of: rock, coral, plants, sand. Built once; prototypes in
// their own frame (y up, the foot at the origin), sand in world metres.
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

// 24 bytes, as instance.glsl and floor.vert read them.
struct SolidVertex {
    glm::vec3 position{};
    glm::i8vec4 normal{};    // w: how rough, 0 smooth to 127 bare rock
    glm::u8vec4 albedo{};    // of half the tint; w: openness to the light from above
    glm::u8vec4 response{};  // share of the sway, translucency, fluorescence, relief
};
static_assert(sizeof(SolidVertex) == 24);

struct Mesh {
    std::vector<SolidVertex> vertices;
    std::vector<std::uint32_t> indices;
};

// Four levels of detail, the finest first.
inline constexpr std::size_t kLevels = 4;
using Levels = std::array<Mesh, kLevels>;

struct Surface {  // what a thing is made of
    glm::vec3 albedo{0.5F};
    float roughness = 0.0F;
    float translucency = 0.0F;  // above a half it is a leaf, lit on the side that looks at us
    float fluorescence = 0.0F;
    float relief = 0.0F;  // 0 polyps to 1 the meanders of a brain coral
    float sway = 0.0F;    // the share of the height at which it hangs on a bending stem
};

std::uint32_t addVertex(
    Mesh& mesh, glm::vec3 position, glm::vec3 normal, const Surface& surface, float skyOpenness);
void addQuad(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);
// Rows of equal length, already added one after the other, become a skin.
void joinRows(Mesh& mesh, std::uint32_t first, int rows, int columns);
// Turns the triangles from `firstIndex` on over.
void turnOver(Mesh& mesh, std::size_t firstIndex);
// For each vertex the first of those that lie at its place: the faces of a seam have each their
// own.
[[nodiscard]] std::vector<std::uint32_t> seamsOf(const Mesh& mesh, std::uint32_t first = 0);
// Area-weighted normals for all vertices from `first` on, of the triangles from `firstIndex` on.
// Vertices at one place share their normal.
void setSmoothNormals(Mesh& mesh, std::uint32_t first, std::size_t firstIndex);

// Where the sun stands, and how much of it and of the light from above the boulders take away:
// computed once, as neither sun nor rock moves.

// 0 dark to 1 open. Boulders count as balls; soft edges, as the sun's light is already spread.
[[nodiscard]] float sunOpenness(std::span<const place::Rock> rocks, glm::vec3 place);
[[nodiscard]] float skyOpenness(std::span<const place::Rock> rocks,
                                glm::vec3 place,
                                glm::vec3 normal);

// A boulder's own ball is left to its baked openness.
void shade(Mesh& mesh, std::span<const place::Rock> others);

}  // namespace aquarama::scene
