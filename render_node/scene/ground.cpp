// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/ground.h"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/place/place.h"
#include "render_node/gl/program.h"
#include "render_node/scene/solid_array.h"
#include "render_node/scene/texture.h"

namespace aquarama {

namespace {

constexpr float kPatchMetres = 10.0F;
constexpr int kPatchesASide = 14;
constexpr std::array<int, 3> kCells{24, 10, 4};
constexpr std::array<float, 2> kLevelMetres{13.0F, 26.0F};
constexpr float kRimMetres = 0.35F;

glm::vec3 sandNormal(std::uint32_t seed, glm::vec2 xz) {
    constexpr float kStep = 0.05F;
    const float here = floorHeight({seed}, xz);
    const float slopeX = (floorHeight({seed}, {xz.x + kStep, xz.y}) - here) / kStep;
    const float slopeZ = (floorHeight({seed}, {xz.x, xz.y + kStep}) - here) / kStep;
    return glm::normalize(glm::vec3{-slopeX, 1.0F, -slopeZ});
}

}  // namespace

Mesh layPatch(std::uint32_t seed, glm::vec2 corner, float sideMetres, int cells) {
    Mesh mesh;
    const int width = cells + 3;  // corners, and the rim on both sides
    for (int row = 0; row < width; ++row)
        for (int column = 0; column < width; ++column) {
            const glm::ivec2 inside = glm::clamp(glm::ivec2{column, row} - 1, 0, cells);
            const bool rim = inside != glm::ivec2{column, row} - 1;
            const glm::vec2 xz =
                corner + glm::vec2(inside) * (sideMetres / static_cast<float>(cells));
            const float height = floorHeight({seed}, xz) - (rim ? kRimMetres : 0.0F);
            addVertex(mesh, {xz.x, height, xz.y}, sandNormal(seed, xz), {}, 1.0F);
        }
    joinRows(mesh, 0, width, width);
    return mesh;
}

Ground::Ground(std::uint32_t seed)
    : program_{gl::makeProgram({"floor.vert", "floor.frag"})},
      detail_{makeTexture(sandTile())} {
    Mesh all;
    constexpr float kHalf = kPatchMetres * kPatchesASide / 2.0F;
    for (std::size_t level = 0; level < levels_.size(); ++level) {
        // All patches share a level's triangles.
        const Mesh mesh = layPatch(seed, {}, kPatchMetres, kCells[level]);
        levels_[level] = {all.indices.size() * sizeof(std::uint32_t),
                          static_cast<int>(mesh.indices.size())};
        all.indices.insert(all.indices.end(), mesh.indices.begin(), mesh.indices.end());
    }
    for (int i = 0; i < kPatchesASide * kPatchesASide; ++i) {
        const glm::vec2 corner =
            glm::vec2{i % kPatchesASide, i / kPatchesASide} * kPatchMetres - kHalf;
        const glm::vec2 middle = corner + kPatchMetres / 2.0F;
        Patch& patch = patches_.emplace_back();
        patch.centre = {middle.x, floorHeight({seed}, middle), middle.y};
        patch.finest = finestLevelOf(patch.centre, kLevelMetres);
        for (std::size_t level = patch.finest; level < levels_.size(); ++level) {
            const Mesh mesh = layPatch(seed, corner, kPatchMetres, kCells[level]);
            patch.firstVertices[level] = static_cast<int>(all.vertices.size());
            all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
        }
    }
    setSolids(array_, vertices_, indices_, all);
}

void Ground::draw(const Viewpoint& viewpoint) const {
    glUseProgram(program_.name());
    glBindTextureUnit(14, detail_.name());
    glBindVertexArray(array_.name());
    constexpr float kPatchRadius = kPatchMetres * 0.75F;
    for (const Patch& patch : patches_) {
        if (!viewpoint.sees(patch.centre, kPatchRadius)) continue;
        const std::size_t level =
            std::max(viewpoint.levelOf(patch.centre, kLevelMetres), patch.finest);
        glDrawElementsBaseVertex(GL_TRIANGLES,
                                 levels_[level].count,
                                 GL_UNSIGNED_INT,
                                 byteOffset(levels_[level].firstByte),
                                 patch.firstVertices[level]);
    }
}

}  // namespace aquarama
