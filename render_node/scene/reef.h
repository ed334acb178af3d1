// SPDX-License-Identifier: Apache-2.0
// The boulders with all that grows on them, at five levels of detail.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "common/place/place.h"
#include "render_node/gl/handle.h"
#include "render_node/scene/coral_mesh.h"
#include "render_node/scene/frustum.h"

namespace aquarama {

inline constexpr int kReefLevels = 5;
// One boulder and its corals.
[[nodiscard]] ReefMesh growBoulder(const Rock& rock, int level);

class Reef {
  public:
    explicit Reef(std::uint32_t seed);
    void draw(const Viewpoint& viewpoint);

  private:
    struct Range {
        std::size_t firstByte = 0;
        int count = 0;
        int firstVertex = 0;
    };
    struct Boulder {
        glm::vec3 centre{};
        float radiusMetres = 0.0F;
        std::array<Range, kReefLevels> stone{};
        std::array<Range, kReefLevels> growth{};
    };
    std::vector<Boulder> boulders_;
    std::vector<const Boulder*> inView_;  // of the draw under way
    gl::Buffer vertices_, indices_;
    gl::VertexArray array_;
    [[nodiscard]] static Range append(Mesh& all, const Mesh& mesh);
    void drawPart(const Viewpoint& viewpoint, std::array<Range, kReefLevels> Boulder::*part) const;

    gl::ProgramHandle stoneProgram_, growthProgram_;
    gl::Texture detail_;
};

}  // namespace aquarama
