// SPDX-License-Identifier: Apache-2.0
// Draws food in the water: plankton that glints, and pellets that tumble.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "render_node/gl/handle.h"
#include "render_node/gl/program.h"

namespace aquarama::scene {

// One particle of food at the frame's moment, world frame.
struct FoodParticle {
    glm::vec3 positionMetres{};
    // Seed of its look and of its tumbling; the same for as long as the particle exists.
    std::uint32_t seed = 0;
    // A pellet, else plankton.
    bool isPellet = false;
};

// Owns its GL objects; construct, use and destroy with the same context current.
class FoodSpecks {
  public:
    explicit FoodSpecks(const gl::Replacements& replacements);
    // Uploads the frame's food. The shaders leave out what a view cannot see.
    void update(std::span<const FoodParticle> food);
    // Blends them over what is drawn: call it after all solid things. Expects the frame's uniform
    // block and the sea's light to be bound.
    void draw() const;

  private:
    // Layout of Speck in food_particle.glsl, std430.
    struct Speck {
        glm::vec3 positionMetres{};
        std::uint32_t seed = 0;
    };
    void drawPellets() const;
    void drawPlankton() const;

    gl::ProgramHandle plankton_, pellets_;
    gl::Buffer specks_;
    gl::VertexArray empty_;
    // What is in the buffer: pellets first, then plankton.
    std::vector<Speck> all_;
    int pelletCount_ = 0;
};

}  // namespace aquarama::scene
