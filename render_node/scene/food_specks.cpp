// SPDX-License-Identifier: Apache-2.0
#include "render_node/scene/food_specks.h"

#include <cassert>

#include <glm/geometric.hpp>

#include "render_node/gl/program.h"
#include "render_node/quality/quality.h"
#include "render_node/shaders/shader_interface.h"

namespace aquarama::scene {

namespace {

// The margin for particles that are drawn larger than they are, metres. Beyond kPelletMetres and
// kPlanktonMetres particles are smaller than a pixel; the shaders fade them out before.
constexpr float kMarginMetres = 0.05F;
// Vertices of an octahedron whose eight faces share no corners, so that each has its own normal.
constexpr int kPelletVertices = 24;

// Near enough and inside the frustum.
bool isSeen(const FoodParticle& particle, const Viewpoint& viewpoint) {
    const float farthest = particle.isPellet ? shaders::kPelletMetres : shaders::kPlanktonMetres;
    const glm::vec3 way = particle.positionMetres - viewpoint.eyeMetres;
    return glm::dot(way, way) < farthest * farthest &&
           viewpoint.sees(particle.positionMetres, kMarginMetres);
}

}  // namespace

FoodSpecks::FoodSpecks(const gl::Replacements& replacements)
    : plankton_{gl::makeProgram({"plankton.vert", "snow.frag"}, replacements)},
      pellets_{gl::makeProgram({"pellet.vert", "pellet.frag"}, replacements)} {}

void FoodSpecks::update(std::span<const FoodParticle> food, const Viewpoint& viewpoint) {
    seen_.clear();
    // Two passes over the particles, so that each kind is contiguous in the buffer.
    for (const bool pellets : {true, false}) {
        for (const FoodParticle& particle : food)
            if (particle.isPellet == pellets && isSeen(particle, viewpoint))
                seen_.push_back({particle.positionMetres, particle.seed});
        if (pellets) pelletCount_ = static_cast<int>(seen_.size());
    }
    if (seen_.empty()) return;
    glNamedBufferData(specks_.name(),
                      static_cast<GLsizeiptr>(seen_.size() * sizeof(Speck)),
                      seen_.data(),
                      GL_STREAM_DRAW);
}

void FoodSpecks::draw() const {
    assert(pelletCount_ >= 0);
    assert(static_cast<std::size_t>(pelletCount_) <= seen_.size());
    const gl::Stage stage{"food"};
    if (seen_.empty()) return;
    glBindVertexArray(empty_.name());
    gl::bindStorage(shaders::kSpecksStorage, specks_);
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    if (pelletCount_ > 0) drawPellets();
    if (seen_.size() > static_cast<std::size_t>(pelletCount_)) drawPlankton();
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
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(seen_.size()) - pelletCount_);
}

}  // namespace aquarama::scene
