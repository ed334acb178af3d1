// SPDX-License-Identifier: Apache-2.0
// The sand: square patches at three levels of detail, and the shade that boulders cast on it.
#pragma once

#include <array>
#include <cstdint>
#include <tuple>
#include <vector>

#include <glm/gtc/type_precision.hpp>
#include <glm/vec2.hpp>

#include "render_node/gl/handle.h"
#include "render_node/gl/program.h"
#include "render_node/quality/quality.h"
#include "render_node/reef/mesh.h"

namespace aquarama::scene {

// A square patch of sand with this number of cells along a side, in world metres; `corner` is its
// least x and z. A rim hangs down around it, so that no gap shows where two levels meet.
[[nodiscard]] Mesh layPatch(std::uint32_t seed, glm::vec2 corner, float sideMetres, int cells);

// The tables of the sand for the GPU, before they are uploaded.
struct GroundTables {
    // A patch: its middle on the sand, world metres, and for each level the index of its first
    // vertex.
    struct Patch {
        glm::vec3 centre{};
        std::array<int, 3> firstVertices{};
    };
    // The triangles of a level, which all patches share: a range of indices.
    struct Level {
        std::uint32_t firstIndex = 0;
        std::int32_t count = 0;
    };
    // Vertices of all patches at all levels, and where each is on the next level.
    std::vector<SolidVertex> vertices;
    std::vector<CoarseVertex> coarse;
    std::vector<std::uint32_t> indices;
    std::vector<Patch> patches;
    std::vector<Level> levels;
    // A map of kFloorShadeMetres about the origin, by rows: sun visibility (r) and ambient
    // occlusion (g), rubble (b).
    std::vector<glm::u8vec4> shade;

    // All arrays, for the cache of derived data.
    auto arrays() { return std::tie(vertices, coarse, indices, patches, levels, shade); }
};

// Takes the tables from the cache of derived data, or makes them once on this machine.
[[nodiscard]] GroundTables groundTables(const place::PlaceKey& place);

// Draws the sand. Owns its GL objects; construct, use and destroy it with the same context current.
class Ground {
  public:
    Ground(const GroundTables& tables, const LightQuality& light);
    // Draws the patches that the viewpoint sees. Expects the frame's uniform block and the sea's
    // light to be bound.
    void draw(const Viewpoint& viewpoint) const;
    // A program that writes depth only, for shadow maps, and the draw with it.
    [[nodiscard]] static gl::ProgramHandle depthProgram();
    void drawDepths(const gl::ProgramHandle& program, const Viewpoint& viewpoint) const;

  private:
    void drawPatches(const Viewpoint& viewpoint) const;

    std::vector<GroundTables::Patch> patches_;
    std::vector<GroundTables::Level> levels_;
    gl::Buffer vertices_, coarse_, indices_;
    gl::VertexArray array_;
    gl::ProgramHandle program_;
    gl::Texture detail_, rubble_, shade_;
};

}  // namespace aquarama::scene
