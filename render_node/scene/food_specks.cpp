// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/food_specks.h"

#include <cassert>

#include "render_node/gl/program.h"
#include "render_node/shaders/shader_interface.h"

namespace aquarama::scene {

namespace {

// Vertices of an octahedron whose eight faces share no corners, so that each has its own normal.
constexpr int kPelletVertices = 24;

}  // namespace

FoodSpecks::FoodSpecks(const gl::Replacements& replacements)
    : plankton_{gl::makeProgram({"plankton.vert", "snow.frag"}, replacements)},
      pellets_{gl::makeProgram({"pellet.vert", "pellet.frag"}, replacements)} {}

void FoodSpecks::update(std::span<const FoodParticle> food) {
    all_.clear();
    // Two passes over the particles, so that each kind is contiguous in the buffer.
    for (const bool pellets : {true, false}) {
        for (const FoodParticle& particle : food)
            if (particle.isPellet == pellets)
                all_.push_back({particle.positionMetres, particle.seed});
        if (pellets) pelletCount_ = static_cast<int>(all_.size());
    }
    if (all_.empty()) return;
    glNamedBufferData(specks_.name(),
                      static_cast<GLsizeiptr>(all_.size() * sizeof(Speck)),
                      all_.data(),
                      GL_STREAM_DRAW);
}

void FoodSpecks::draw() const {
    assert(pelletCount_ >= 0);
    assert(static_cast<std::size_t>(pelletCount_) <= all_.size());
    const gl::Stage stage{"food"};
    if (all_.empty()) return;
    glBindVertexArray(empty_.name());
    gl::bindStorage(shaders::kSpecksStorage, specks_);
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    if (pelletCount_ > 0) drawPellets();
    if (all_.size() > static_cast<std::size_t>(pelletCount_)) drawPlankton();
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
}

// The vertex shader enlarges a pellet of less than three pixels to that size, and makes it fainter
// in proportion to its area.
void FoodSpecks::drawPellets() const {
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glUseProgram(pellets_.name());
    glDrawArraysInstanced(GL_TRIANGLES, 0, kPelletVertices, pelletCount_);
}

// Points of light, added: plankton is clear and hides nothing. The uniform skips the pellets at the
// front of the buffer.
void FoodSpecks::drawPlankton() const {
    glBlendFunc(GL_ONE, GL_ONE);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glUseProgram(plankton_.name());
    glUniform1i(shaders::kFirstLocation, pelletCount_);
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(all_.size()) - pelletCount_);
}

}  // namespace aquarama::scene
