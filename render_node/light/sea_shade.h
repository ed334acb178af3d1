// SPDX-License-Identifier: Apache-2.0
// What stands between the sea and the light from above: maps of the place, drawn once, and of the
// fish, drawn each frame. See shadow.glsl for how they are read.
#pragma once

#include <functional>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "render_node/gl/handle.h"
#include "render_node/reef/quality.h"
#include "render_node/surface/school_surface.h"

namespace aquarama::scene {

class SeaShade {
  public:
    explicit SeaShade(const LightQuality& quality);

    // Draws the place straight from above and along the sun's rays. drawPlace draws all of it with
    // the matrix it is given as clipFromWorld, into the depth buffer that is bound. Never called:
    // nothing stands in the way.
    void setPlace(const std::function<void(const glm::mat4&)>& drawPlace);

    // Expects the frame's uniform block to be bound, and the sea's with fishWindow(): so the map of
    // fish lies about the shared eye, in whole texels of the world.
    void updateFish(const surface::SchoolSurface& school);
    [[nodiscard]] glm::vec4 fishWindow(glm::vec3 sharedEyeMetres) const;  // of SeaNow
    void bind() const;  // to the units that shadow.glsl names

  private:
    void clear();
    void takeMoments(const gl::Texture& depth, const gl::Framebuffer& heights);

    LightQuality quality_;
    gl::Texture sunHeights_, topHeights_, fishOnTheWay_;
    gl::Framebuffer sunTarget_, topTarget_, fishTarget_;
    gl::ProgramHandle moments_, fishProgram_;
    gl::VertexArray empty_;
};

}  // namespace aquarama::scene
