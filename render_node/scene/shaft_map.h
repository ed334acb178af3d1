// SPDX-License-Identifier: Apache-2.0
// The shafts of sunlight in the water, as a map over all directions from the eye of a view.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "render_node/gl/handle.h"
#include "render_node/quality/quality.h"
#include "render_node/scene/sea_shade.h"

namespace aquarama::scene {

// Owns its GL objects; construct, use and destroy it with the same context current.
class ShaftMap {
  public:
    explicit ShaftMap(const LightQuality& quality);
    // Draws the directions that this view reads. Expects the uniform blocks of frame and sea to be
    // bound. Switches the depth test off.
    void draw(glm::vec3 eyeMetres,
              const glm::mat4& worldFromClip,
              const gl::Texture& causticLayers,
              const SeaShade& shade);
    // An octahedral map; see shaft.frag.
    [[nodiscard]] const gl::Texture& texture() const { return map_; }

  private:
    int texels_, steps_;
    gl::Texture map_;
    gl::Framebuffer target_;
    gl::ProgramHandle program_;
    gl::VertexArray empty_;
};

}  // namespace aquarama::scene
