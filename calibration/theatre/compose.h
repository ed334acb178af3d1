// SPDX-License-Identifier: Apache-2.0
// The simulated hall: adds up, in linear light, what the projectors throw on the screen.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

#include "common/config/rig.h"
#include "common/wall/picture.h"

namespace aquarama::theatre {

// Where the unrolled screen's pixels lie in the channels' pictures: for many panoramas of one rig.
class PanoramaMap {
  public:
    explicit PanoramaMap(const config::Rig& rig);
    // One picture for each channel of the rig, of its size, as light.
    [[nodiscard]] wall::Light compose(std::span<const wall::Light> channels) const;

    struct Sample {
        std::uint32_t place = 0;  // in the panorama, row by row
        glm::vec2 pixel{};        // of the channel's picture, continuous
    };

  private:
    glm::ivec2 sizePixels_;
    std::vector<std::vector<Sample>> samples_;  // of each channel
};

// The unrolled screen. One picture for each channel of the rig, of its size, as light.
[[nodiscard]] wall::Light composePanorama(const config::Rig& rig,
                                          std::span<const wall::Light> channels);

// Of the hall's picture and clip.
inline constexpr glm::ivec2 kHallPixels(1600, 900);

// What somebody at the back of a dark hall sees of it, over the heads of the audience.
[[nodiscard]] wall::Light composeHall(const config::Rig& rig,
                                      const wall::Light& panorama,
                                      glm::ivec2 sizePixels);

}  // namespace aquarama::theatre
