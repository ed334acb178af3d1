// SPDX-License-Identifier: Apache-2.0
// The simulated hall: adds up, in linear light, what the projectors throw on the screen, and writes
// the two pictures that are composed of a snapshot.
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

// What projectors throw for the codes of their pictures: sRGB, or where a channel's wall file has a
// colour what that says. Immutable.
class Projectors {
  public:
    // Throws Error where a wall file cannot be used.
    explicit Projectors(const config::Rig& rig) : colours_{wall::coloursOf(rig)} {}
    [[nodiscard]] Light thrown(std::size_t channel, const Picture& picture) const;

  private:
    std::vector<std::optional<formats::ChannelColour>> colours_;
};

// Where the unrolled screen's pixels lie in the channels' pictures. Made once for many panoramas of
// one rig.
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

// The unrolled screen, of one picture for each channel as above.
[[nodiscard]] Light composePanorama(const config::Rig& rig, std::span<const Light> channels);

// Size of the hall's picture and clip.
inline constexpr glm::ivec2 kHallPixels(1600, 900);

// What a visitor at the back of the dark hall sees, over the heads of the audience. `channels`: as
// above, for panels, whose panorama is coarse above and below; else they may be left out. Takes
// seconds; uses all processors.
[[nodiscard]] Light composeHall(const config::Rig& rig,
                                const Light& panorama,
                                glm::ivec2 sizePixels,
                                std::span<const Light> channels = {});

// The same of any light on a screen, which may differ from what a rig means. `panorama`: the
// screen's, coarse, for what it throws on the room.
[[nodiscard]] Light composeHall(const wall::ScreenSurface& screen,
                                const Light& panorama,
                                const ScreenLight& light,
                                glm::ivec2 sizePixels);

// What every channel of folder/channel-NAME.png throws on the wall, seen without glasses: of two
// eyes that its display parts again the mean of channel-NAME.left_eye.png and .right_eye.png.
// Throws Error when a picture is missing or has not its channel's size.
[[nodiscard]] std::vector<Light> readChannels(const config::Rig& rig, const std::string& folder);

// Writes folder/panorama.png and folder/hall.png with 8 or 16 bits. Throws Error where they cannot
// be written.
void writePanoramaAndHall(const config::Rig& rig,
                          const Light& panorama,
                          std::span<const Light> channels,
                          const std::string& folder,
                          int bits);

// Composes folder/panorama.png and folder/hall.png, and in stereo panorama.left_eye.png and
// .right_eye.png, of the channels' pictures there. Throws as readChannels() and
// writePanoramaAndHall() do.
void composeSnapshot(const config::Rig& rig, const std::string& folder, int bits);

}  // namespace aquarama::compose
