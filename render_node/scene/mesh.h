// SPDX-License-Identifier: Apache-2.0
// Triangles of things that stand still: rock, coral, sand. Built once from a seed, in world metres.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/gtc/type_precision.hpp>
#include <glm/vec3.hpp>

namespace aquarama {

// 24 bytes, as rock.vert reads them.
struct SolidVertex {
    glm::vec3 position{};
    glm::i8vec4 normal{};    // w: how rough, 0 smooth to 127 bare rock
    glm::u8vec4 albedo{};    // w: openness to the light from above
    glm::u8vec4 response{};  // openness to the sun, translucency, fluorescence, unused
};
static_assert(sizeof(SolidVertex) == 24);

struct Mesh {
    std::vector<SolidVertex> vertices;
    std::vector<std::uint32_t> indices;
};

struct Surface {  // what a thing is made of
    glm::vec3 albedo{0.5F};
    float roughness = 0.0F;
    float translucency = 0.0F;
    float fluorescence = 0.0F;
};

std::uint32_t addVertex(
    Mesh& mesh, glm::vec3 position, glm::vec3 normal, const Surface& surface, float skyOpenness);
void addQuad(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d);
// Rows of equal length, already added one after the other, become a skin.
void joinRows(Mesh& mesh, std::uint32_t first, int rows, int columns);
// Area-weighted normals for all vertices from `first` on, of the triangles from `firstIndex` on.
void setSmoothNormals(Mesh& mesh, std::uint32_t first, std::size_t firstIndex);

}  // namespace aquarama
