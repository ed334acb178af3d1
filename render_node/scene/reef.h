// SPDX-License-Identifier: Apache-2.0
// All rock, coral and plants: a library of prototypes at four levels of detail, and instances that
// one compute pass culls and sorts by level. What a frame costs the processor does not grow with
// what stands in the sea.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/place/place.h"
#include "render_node/gl/handle.h"
#include "render_node/scene/mesh.h"
#include "render_node/scene/quality.h"
#include "render_node/scene/scatter.h"

namespace aquarama {

// Every prototype; grown on all processors.
using Library = std::array<Levels, kPrototypes>;
[[nodiscard]] Library growLibrary();

struct ReefRule {
    bool culling = true;
    bool levelsOfDetail = true;
};

class Reef {
  public:
    Reef(const PlaceKey& place, const Quality& quality);

    // Once a frame: what the school, whose records are bound, stirs of the water about the shared
    // eye.
    void stir(std::size_t fish, float fraction) const;
    // For the view of the frame's uniforms, which are bound.
    void cull(const ReefRule& rule) const;
    // What the last cull has chosen, what fills most of the view first.
    void draw() const;

  private:
    void cullGroups(const ReefRule& rule) const;
    void fillLibrary(const Library& library, const std::vector<Instance>& scattered);

    Quality quality_;
    unsigned groupCount_ = 0;
    unsigned instanceCount_ = 0;
    gl::Buffer vertices_, indices_, instances_, prototypes_, groups_, seenGroups_, chosen_, none_,
        commands_, wake_;
    gl::VertexArray array_;
    gl::ProgramHandle group_, cull_, stone_, growth_, farGrowth_, stir_;
    gl::Texture detail_;
};

}  // namespace aquarama
