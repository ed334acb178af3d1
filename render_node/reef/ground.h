// SPDX-License-Identifier: Apache-2.0
// The sand: squares of it at three levels of detail, with the shade that boulders cast on it.
#pragma once

#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

#include <glm/gtc/type_precision.hpp>
#include <glm/vec2.hpp>

#include "render_node/gl/handle.h"
#include "render_node/gl/program.h"
#include "render_node/reef/mesh.h"
#include "render_node/reef/quality.h"

namespace aquarama::scene {

// A square of sand with so many cells a side, its rim hanging down a little so that no gap shows
// where two levels meet.
[[nodiscard]] Mesh layPatch(std::uint32_t seed, glm::vec2 corner, float sideMetres, int cells);

// What the GPU keeps of the sand.
struct GroundTables {
    struct Patch {
        glm::vec3 centre{};
        std::array<int, 3> firstVertices{};
    };
    struct Level {
        std::uint32_t firstIndex = 0;
        std::int32_t count = 0;
    };
    std::vector<SolidVertex> vertices;  // of all patches at all levels
    std::vector<std::uint32_t> indices;
    std::vector<Patch> patches;
    std::vector<Level> levels;
    std::vector<glm::u8vec4> shade;  // openness to the sun and from above, rubble; texels by rows

    auto arrays() { return std::tie(vertices, indices, patches, levels, shade); }
};

// Laid once on a machine: derived data.
[[nodiscard]] GroundTables groundTables(std::uint32_t seed);

class Ground {
  public:
    Ground(const GroundTables& tables, const gl::Replacements& replacements);
    void draw(const Viewpoint& viewpoint) const;
    // The same for a map of depths: without light.
    [[nodiscard]] static gl::ProgramHandle depthProgram();
    void drawDepths(const gl::ProgramHandle& program, const Viewpoint& viewpoint) const;

  private:
    void drawPatches(const Viewpoint& viewpoint) const;

    std::vector<GroundTables::Patch> patches_;
    std::vector<GroundTables::Level> levels_;
    gl::Buffer vertices_, indices_;
    gl::VertexArray array_;
    gl::ProgramHandle program_;
    gl::Texture detail_, rubble_, shade_;
};

}  // namespace aquarama::scene
