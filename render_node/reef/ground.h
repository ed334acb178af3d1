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
#include "render_node/reef/place_draw.h"

namespace aquarama::scene {

// A square patch of sand with this number of cells along a side, in world metres; `corner` is its
// least x and z. A rim hangs down around it, so that no gap shows where two levels meet.
[[nodiscard]] Mesh layPatch(std::uint32_t seed, glm::vec2 corner, float sideMetres, int cells);

// The tables of the sand for the GPU, before they are uploaded.
struct GroundTables {
    // Vertices of all patches at all levels, and where each is on the next level.
    std::vector<SolidVertex> vertices;
    std::vector<CoarseVertex> coarse;
    std::vector<std::uint32_t> indices;
    // A ball about each patch: centre, radius; world metres.
    std::vector<glm::vec4> balls;
    // The draw of each patch at each level, kSandLevels for a patch; its instance is the patch's
    // number.
    std::vector<DrawCommand> draws;
    // A map of kFloorShadeMetres about the origin, by rows: sun visibility (r) and ambient
    // occlusion (g), rubble (b).
    std::vector<glm::u8vec4> shade;

    // All arrays, for the cache of derived data.
    auto arrays() { return std::tie(vertices, coarse, indices, balls, draws, shade); }
};

// Takes the tables from the cache of derived data, or makes them once on this machine.
[[nodiscard]] GroundTables groundTables(const place::PlaceKey& place);

// Draws the sand: for each view cull(), then draw(). Owns its GL objects; construct, use and
// destroy it with the same context current.
class Ground {
  public:
    Ground(const GroundTables& tables, const LightQuality& light);
    // Selects patches for the view in the frame's uniform block, which must be bound, and their
    // levels of detail by the distance from the shared eye (world frame), so that all nodes agree.
    // Distances are divided by `reach`.
    void cull(const PlaceRule& rule, glm::vec3 sharedEyeMetres, float reach) const;
    // Draws the patches that the last cull() selected. Expects the frame's uniform block and the
    // sea's light to be bound.
    void draw() const;
    // A program that writes depth only, for shadow maps, and the draw with it.
    [[nodiscard]] static gl::ProgramHandle depthProgram();
    void drawDepths(const gl::ProgramHandle& program) const;

  private:
    void fillBuffers(const GroundTables& tables);
    void drawPatches() const;

    unsigned patchCount_ = 0;
    gl::Buffer vertices_, coarse_, indices_, balls_, draws_, commands_, faded_;
    gl::VertexArray array_;
    gl::ProgramHandle cull_, program_;
    gl::Texture detail_, rubble_, shade_;
};

}  // namespace aquarama::scene
