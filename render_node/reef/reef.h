// SPDX-License-Identifier: Apache-2.0
// All rock, coral and plants: a library of prototypes at four levels of detail, and instances that
// one compute pass culls and sorts by level. What a frame costs the processor does not grow with
// what stands in the sea.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "common/place/place.h"
#include "render_node/gl/handle.h"
#include "render_node/reef/mesh.h"
#include "render_node/reef/quality.h"
#include "render_node/reef/scatter.h"

namespace aquarama::scene {

// Every prototype; grown on all processors.
using Library = std::array<Levels, kPrototypes>;
[[nodiscard]] Library growLibrary();

// As glMultiDrawElementsIndirect reads it.
struct DrawCommand {
    std::uint32_t count = 0;
    std::uint32_t instanceCount = 0;
    std::uint32_t firstIndex = 0;
    std::int32_t baseVertex = 0;
    std::uint32_t baseInstance = 0;
};
static_assert(sizeof(DrawCommand) == 20);

// As place_cull.comp reads it.
struct Prototype {
    float reach = 0.0F;  // about the middle of its height, for a scale of 1
    float middle = 0.0F;
    std::uint32_t firstCommand = 0;
    std::uint32_t commandStride = 0;           // from a level's command to the next level's
    std::array<float, kLevels> leastPixels{};  // of scale, for each level; smaller is not drawn
};
static_assert(sizeof(Prototype) == 32);

// What the GPU keeps of a reef.
struct ReefTables {
    std::vector<SolidVertex> vertices;  // of all prototypes at all levels
    std::vector<std::uint32_t> indices;
    std::vector<Instance> instances;
    std::vector<Prototype> prototypes;
    std::vector<DrawCommand> commands;  // of each prototype and level, with no instance yet
    std::vector<glm::vec4> groups;      // a ball about the instances of each workgroup

    auto arrays() { return std::tie(vertices, indices, instances, prototypes, commands, groups); }
};

// Grown once on a machine: derived data.
[[nodiscard]] ReefTables reefTables(const place::PlaceKey& place);

struct ReefRule {
    bool culling = true;
    bool levelsOfDetail = true;
};

class Reef {
  public:
    Reef(const ReefTables& tables, const Quality& quality);

    // Once a frame: what the school, whose records are bound, stirs of the water about the shared
    // eye.
    void stir(std::size_t fish, float fraction) const;
    // For the view of the frame's uniforms, which are bound.
    void cull(const ReefRule& rule) const;
    // What the last cull has chosen, what fills most of the view first.
    void draw() const;
    // The same for a map of depths: without light.
    struct DepthPrograms {
        gl::ProgramHandle growth, stone;
    };
    [[nodiscard]] DepthPrograms depthPrograms() const;
    void drawDepths(const DepthPrograms& programs) const;

  private:
    void bind() const;
    void cullGroups(const ReefRule& rule) const;
    void fillBuffers(const ReefTables& tables);

    Quality quality_;
    unsigned groupCount_ = 0;
    unsigned instanceCount_ = 0;
    gl::Buffer vertices_, indices_, instances_, prototypes_, groups_, seenGroups_, chosen_, none_,
        commands_, wake_;
    gl::VertexArray array_;
    gl::ProgramHandle group_, cull_, stone_, growth_, farGrowth_, stir_;
    gl::Texture detail_;
};

}  // namespace aquarama::scene
