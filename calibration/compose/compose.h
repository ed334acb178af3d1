// SPDX-License-Identifier: Apache-2.0
// Composes the pictures of channels to a panorama and to a picture of the hall, in linear light.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "calibration/compose/room.h"
#include "common/base/picture.h"
#include "common/config/rig.h"
#include "common/formats/wall_file.h"
#include "common/wall/optics.h"
#include "common/wall/surface.h"

namespace aquarama::compose {

// The light of projectors for the codes of their pictures: by sRGB, or by the colour in a channel's
// wall file. Immutable.
class Projectors {
  public:
    // Throws Error where a wall file cannot be used.
    explicit Projectors(const config::Rig& rig) : colours_{wall::coloursOf(rig)} {}
    [[nodiscard]] Light thrown(std::size_t channel, const Picture& picture) const;

  private:
    std::vector<std::optional<formats::ChannelColour>> colours_;
};

// The places of the panorama's pixels in the channels' pictures, computed once for many panoramas.
class PanoramaMap {
  public:
    explicit PanoramaMap(const config::Rig& rig);
    // One picture for each channel of the rig, in its order and of its size, as light.
    [[nodiscard]] Light compose(std::span<const Light> channels) const;

    // A pixel of the panorama that a channel lights.
    struct Sample {
        std::uint32_t place = 0;  // in the panorama, row by row
        glm::vec2 pixel{};        // of the channel's picture, continuous
    };

  private:
    glm::ivec2 sizePixels_;
    std::vector<std::vector<Sample>> samples_;  // of each channel
};

// The unrolled screen, composed of one picture for each channel as above.
[[nodiscard]] Light composePanorama(const config::Rig& rig, std::span<const Light> channels);

// The size of the hall's picture and clip.
inline constexpr glm::ivec2 kHallPixels(1600, 900);

// The view of a visitor at the back of the dark hall, over the heads of the audience. `channels`:
// as above; only panels need them, as their panorama is coarse above and below. Takes seconds; uses
// all processors.
[[nodiscard]] Light composeHall(const config::Rig& rig,
                                const Light& panorama,
                                glm::ivec2 sizePixels,
                                std::span<const Light> channels = {});

// The same for any light on a screen, which may differ from the rig's. `panorama`: a coarse one of
// the screen, for its light on the room.
[[nodiscard]] Light composeHall(const wall::ScreenSurface& screen,
                                const Light& panorama,
                                const ScreenLight& light,
                                glm::ivec2 sizePixels);

// The light of each channel by folder/channel-NAME.png, seen without glasses: where a display
// separates two eyes, the mean of channel-NAME.left_eye.png and .right_eye.png. Throws Error where
// a picture is missing or has another size than its channel.
[[nodiscard]] std::vector<Light> readChannels(const config::Rig& rig, const std::string& folder);

// Writes folder/panorama.png and folder/hall.png with 8 or 16 bits. Throws Error where they cannot
// be written.
void writePanoramaAndHall(const config::Rig& rig,
                          const Light& panorama,
                          std::span<const Light> channels,
                          const std::string& folder,
                          int bits);

// Composes folder/panorama.png and folder/hall.png, and in stereo panorama.left_eye.png and
// .right_eye.png, of the channels' pictures there; with keepPanorama not panorama.png, which a node
// has drawn. Throws as readChannels() and writePanoramaAndHall() do.
void composeSnapshot(const config::Rig& rig,
                     const std::string& folder,
                     int bits,
                     bool keepPanorama = false);

}  // namespace aquarama::compose
