// SPDX-License-Identifier: Apache-2.0
// The sand: squares of it at three levels of detail, with the shade that boulders cast on it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "render_node/gl/handle.h"
#include "render_node/scene/frustum.h"
#include "render_node/scene/mesh.h"

namespace aquarama {

// A square of sand with so many cells a side, its rim hanging down a little so that no gap shows
// where two levels meet.
[[nodiscard]] Mesh layPatch(std::uint32_t seed, glm::vec2 corner, float sideMetres, int cells);

class Ground {
  public:
    explicit Ground(std::uint32_t seed);
    void draw(const Viewpoint& viewpoint) const;

  private:
    struct Patch {
        glm::vec3 centre{};
        std::array<int, 3> firstVertices{};
    };
    struct Level {
        std::size_t firstByte = 0;
        int count = 0;
    };
    std::vector<Patch> patches_;
    std::array<Level, 3> levels_{};
    gl::Buffer vertices_, indices_;
    gl::VertexArray array_;
    gl::ProgramHandle program_;
    gl::Texture detail_, rubble_, shade_;
};

}  // namespace aquarama
