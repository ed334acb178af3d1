// SPDX-License-Identifier: Apache-2.0
// All rock, coral and plants: a library of prototypes at five levels of detail, and instances,
// which a compute pass culls and sorts by level. The processor's cost of a frame does not depend on
// the number of instances.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "common/place/place.h"
#include "render_node/gl/handle.h"
#include "render_node/quality/quality.h"
#include "render_node/reef/mesh.h"
#include "render_node/reef/place_draw.h"
#include "render_node/reef/scatter.h"

namespace aquarama::scene {

// Every prototype (see prototypeOf()). growLibrary() uses all processors; the result does not
// depend on their number.
using Library = std::array<Levels, kPrototypes>;
[[nodiscard]] Library growLibrary();

// Least size in pixels of each level of a prototype: the pixels that its scale fills at the shared
// eye, times Quality::placeDetail. From kFade times that size down the level fades into the next.
[[nodiscard]] std::array<float, kLevels> leastPixelsOf(std::size_t prototype);

// Layout of Prototype in place_cull.comp, std430. Lengths are for a scale of 1.
struct Prototype {
    // Radius about the middle of its height.
    float reach = 0.0F;
    // Height of that middle above the foot.
    float middle = 0.0F;
    std::uint32_t firstCommand = 0;
    // From the command of one level to that of the next.
    std::uint32_t commandStride = 0;
    // Least size of the scale for each level, pixels; what is smaller than the last is not drawn.
    std::array<float, kLevels> leastPixels{};
};
static_assert(sizeof(Prototype) == 36);

// The tables of a reef for the GPU, before they are uploaded.
struct ReefTables {
    // Vertices of all prototypes at all levels.
    std::vector<SolidVertex> vertices;
    // One for each vertex.
    std::vector<CoarseVertex> coarse;
    std::vector<std::uint32_t> indices;
    std::vector<Instance> instances;
    std::vector<Prototype> prototypes;
    // One for each prototype and level, with no instance yet; see commandOf() in reef.cpp.
    std::vector<DrawCommand> commands;
    // For each workgroup of the culling a ball about its instances: centre, radius; world metres.
    std::vector<glm::vec4> groups;

    // All arrays, for the cache of derived data.
    auto arrays() {
        return std::tie(vertices, coarse, indices, instances, prototypes, commands, groups);
    }
};

// Takes the tables from the cache of derived data, or makes them once on this machine.
[[nodiscard]] ReefTables reefTables(const place::PlaceKey& place);

// Draws the reef. For each frame stir(), for each view cull() and draw(). Owns its GL objects;
// construct, use and destroy it with the same context current.
class Reef {
  public:
    Reef(const ReefTables& tables, const Quality& quality);

    // Once for each frame: computes how the fish push the water about the shared eye. The records
    // of the school must be bound (SchoolSurface::bindRecords()); `fish` of them are read,
    // `fraction` of the way between the ticks.
    void stir(std::size_t fish, float fraction) const;
    // Selects instances and levels for the view in the frame's uniform block, which must be bound.
    void cull(const PlaceRule& rule) const;
    // Draws the instances that the last cull() selected; those that fill most of the view come
    // first.
    void draw() const;
    // Programs that write depth only, for shadow maps, and the draw with them.
    struct DepthPrograms {
        gl::ProgramHandle growth, stone;
    };
    [[nodiscard]] DepthPrograms depthPrograms() const;
    void drawDepths(const DepthPrograms& programs) const;

  private:
    void bind() const;
    void cullGroups(const PlaceRule& rule) const;
    void fillBuffers(const ReefTables& tables);

    Quality quality_;
    unsigned groupCount_ = 0;
    unsigned instanceCount_ = 0;
    gl::Buffer vertices_, coarse_, indices_, instances_, prototypes_, groups_, seenGroups_, chosen_,
        none_, commands_, wake_;
    gl::VertexArray array_;
    gl::ProgramHandle group_, cull_, stone_, growth_, farGrowth_, stir_;
    gl::Texture detail_;
};

}  // namespace aquarama::scene
