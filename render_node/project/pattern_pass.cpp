// SPDX-License-Identifier: Apache-2.0
#include "render_node/project/pattern_pass.h"

#include <glm/gtc/type_ptr.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "common/wall/pattern.h"
#include "render_node/gl/program.h"
#include "render_node/shaders/shader_interface.h"

namespace aquarama::project {

namespace {

// Places in pattern.frag.

constexpr float kNoGrey = -1;  // the grid instead

}  // namespace

PatternPass::PatternPass(const wall::ChannelFrustum& frustum, const config::Screen& screen)
    : frustum_{frustum},
      eyeAndRadius_{glm::dvec3(glm::inverse(frustum.cameraFromWall)[3]), screen.radiusMetres},
      program_{gl::makeProgram({"quad.vert", "pattern.frag"})} {}

void PatternPass::drawGrid(unsigned framebuffer, glm::ivec2 sizePixels) const {
    draw(framebuffer, sizePixels, kNoGrey);
}

void PatternPass::drawGrey(unsigned framebuffer, glm::ivec2 sizePixels) const {
    draw(framebuffer, sizePixels, static_cast<float>(wall::kGreyLight));
}

void PatternPass::addGrid(unsigned framebuffer, glm::ivec2 sizePixels) const {
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    draw(framebuffer, sizePixels, kNoGrey);
    glDisable(GL_BLEND);
}

void PatternPass::draw(unsigned framebuffer, glm::ivec2 sizePixels, float greyLight) const {
    const glm::mat3 wallFromCamera(glm::transpose(glm::dmat3(frustum_.cameraFromWall)));
    const glm::vec4 extents(frustum_.left, frustum_.bottom, frustum_.right, frustum_.top);
    const glm::vec4 gridLines(wall::kGridDegrees,
                              wall::kGridMajorDegrees,
                              wall::kGridMinorLight,
                              wall::kGridSigmaDegrees);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glViewport(0, 0, sizePixels.x, sizePixels.y);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_CULL_FACE);
    glUseProgram(program_.name());
    glUniformMatrix3fv(
        shaders::kWallFromCameraLocation, 1, GL_FALSE, glm::value_ptr(wallFromCamera));
    glUniform4fv(shaders::kExtentsLocation, 1, glm::value_ptr(extents));
    glUniform1f(shaders::kGreyLightLocation, greyLight);
    glUniform4fv(shaders::kGridLinesLocation, 1, glm::value_ptr(gridLines));
    glUniform4fv(shaders::kEyeAndRadiusLocation, 1, glm::value_ptr(eyeAndRadius_));
    glBindVertexArray(noVertices_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace aquarama::project
