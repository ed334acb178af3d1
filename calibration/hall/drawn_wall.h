// SPDX-License-Identifier: Apache-2.0
// The pictures that render nodes send to projectors: warped, blended and in the projectors'
// colours, computed without OpenGL.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/base/picture.h"
#include "common/config/rig.h"
#include "common/wall/wall.h"

namespace aquarama::hall {

// The linear light of the content at a point of the rig's screen.
using Content = std::function<glm::vec3(glm::dvec3 point)>;
// The content of a panorama. Keeps references.
[[nodiscard]] Content contentOf(const Light& panorama, const wall::ScreenSurface& screen);
// The content of `aquarama run --pattern grid`. Keeps a reference.
[[nodiscard]] Content gridContent(const wall::Wall& wall);

// The rig with this wall file for all of its channels, instead of the files that it names. Throws
// Error where the file cannot be read.
[[nodiscard]] config::Rig withWallFile(config::Rig rig, const std::string& path);

// Draws the pictures of a rig's channels. Immutable; for any thread.
class DrawnWall {
  public:
    // Throws Error where a wall file of the rig cannot be used.
    explicit DrawnWall(const config::Rig& rig) : rig_{rig}, wall_{rig} {}

    // The light that is sent to a place (continuous) of a channel's picture: linear, 0 to 1; it is
    // sent as sRGB codes.
    [[nodiscard]] glm::vec3 sent(std::size_t channel,
                                 glm::dvec2 pixel,
                                 const Content& content) const;
    // Whole pictures, in the rig's order. Uses all processors.
    [[nodiscard]] std::vector<Light> pictures(const Content& content) const;
    [[nodiscard]] const wall::Wall& wall() const { return wall_; }

  private:
    [[nodiscard]] glm::vec3 shareAt(std::size_t channel,
                                    glm::dvec3 point,
                                    std::size_t pixelIndex) const;

    config::Rig rig_;
    wall::Wall wall_;
};

}  // namespace aquarama::hall
