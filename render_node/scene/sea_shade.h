// SPDX-License-Identifier: Apache-2.0
// Shadow maps of the place, drawn once, and of the fish, drawn each frame. shadow.glsl says how
// they are read.
#pragma once

#include <functional>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "render_node/gl/handle.h"
#include "render_node/quality/quality.h"
#include "render_node/surface/school_surface.h"

namespace aquarama::scene {

// Owns its GL objects; construct, use and destroy it with the same context current.
class SeaShade {
  public:
    explicit SeaShade(const LightQuality& quality);

    // Draws the place as seen from straight above and along the sun's rays. drawPlace draws all of
    // it with the matrix that it is given as clipFromWorld, into the depth buffer that is bound.
    // Without this call nothing throws a shadow.
    void setPlace(const std::function<void(const glm::mat4&)>& drawPlace);

    // Draws the shadows of the fish. Expects the frame's uniform block to be bound, and the sea's
    // block with the current fishWindow().
    void updateFish(const surface::SchoolSurface& school);
    // The window of the fish map for SeaNow: its middle on the surface, x and z in metres, and 1 /
    // its side. It follows the shared eye in steps of whole texels, so that shadows do not shimmer.
    [[nodiscard]] glm::vec4 fishWindow(glm::vec3 sharedEyeMetres) const;
    // Binds the maps to the units that shadow.glsl names.
    void bind() const;

  private:
    // Fills the maps with their values where nothing throws a shadow.
    void clear();
    // Turns a depth map into heights and their squares (moments.frag).
    void takeMoments(const gl::Texture& depth, const gl::Framebuffer& heights);

    LightQuality quality_;
    gl::Texture sunHeights_, topHeights_, fishOnTheWay_;
    gl::Framebuffer sunTarget_, topTarget_, fishTarget_;
    gl::ProgramHandle moments_, fishProgram_;
    gl::VertexArray empty_;
};

}  // namespace aquarama::scene
