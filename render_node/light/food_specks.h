// SPDX-License-Identifier: Apache-2.0
// Food in the water: plankton that glints, and pellets that tumble.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "render_node/gl/handle.h"
#include "render_node/gl/program.h"

namespace aquarama::scene {

struct Viewpoint;

struct FoodParticle {
    glm::vec3 positionMetres{};
    std::uint32_t seed = 0;  // of its look and its tumbling; its own for as long as it is there
    bool isPellet = false;   // else it is plankton
};

// Owns its GL objects; construct, use and destroy with the same context current.
class FoodSpecks {
  public:
    explicit FoodSpecks(const gl::Replacements& replacements);
    // Takes what this view can see: the rest costs a test each.
    void update(std::span<const FoodParticle> food, const Viewpoint& viewpoint);
    // Over all that is solid. Expects the frame's uniform block and the sea's light to be bound.
    void draw() const;

  private:
    // As food_particle.glsl has it.
    struct Speck {
        glm::vec3 positionMetres{};
        std::uint32_t seed = 0;
    };
    void drawPellets() const;
    void drawPlankton() const;

    gl::ProgramHandle plankton_, pellets_;
    gl::Buffer specks_;
    gl::VertexArray empty_;
    std::vector<Speck> seen_;  // pellets first
    int pelletCount_ = 0;
};

}  // namespace aquarama::scene
