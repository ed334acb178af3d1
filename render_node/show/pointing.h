// SPDX-License-Identifier: Apache-2.0
// Where in the world a visitor points who points at a pixel of a channel.
#pragma once

#include <optional>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/config/rig.h"
#include "common/wall/eyes.h"
#include "common/wire/state_codec.h"

namespace aquarama::show {

class Pointing {
  public:
    Pointing(const config::Rig& rig, std::size_t channel)
        : screen_{rig.screen},
          channel_{rig.channels.at(channel)},
          mode_{wall::stereoOf(rig, channel).mode},
          sweetSpot_{rig.sweetSpotMetres} {}

    // Unit vector in the world, from the sweet spot through the point of the screen that the pixel
    // (of the display, continuous, from its top left corner) lights; nothing where it misses the
    // screen.
    [[nodiscard]] std::optional<glm::vec3> directionOf(glm::vec2 pixel, const wire::Eye& eye) const;
    // Where food falls that is dropped there: an arm's length before the submarine, under water.
    // World frame, metres.
    [[nodiscard]] std::optional<glm::vec3> pinchAt(glm::vec2 pixel, const wire::Eye& eye) const;
    [[nodiscard]] glm::vec2 middle() const { return glm::vec2(channel_.sizePixels) * 0.5F; }

  private:
    config::Screen screen_;
    config::Channel channel_;
    config::StereoMode mode_;
    glm::dvec3 sweetSpot_;  // wall frame
};

}  // namespace aquarama::show
