// SPDX-License-Identifier: Apache-2.0
// Pictures of what a channel projects, read back from the GPU.
#pragma once

#include <cstdint>
#include <string>

#include "common/base/picture.h"
#include "render_node/show/channel_picture.h"

namespace aquarama::show {

// Bits of a sample: 8 as the projector gets them, dithered, or 16 without dither.
enum class PictureBits : std::uint8_t { Dithered8, Deep16 };

// Projects and reads back the frame that was drawn last, without overlays of the channel. Waits for
// the GPU.
[[nodiscard]] Picture takePicture(ChannelPicture& picture, PictureBits bits, Shown shown);

// The picture to show to somebody without stereo glasses: one eye's picture where the display
// separates the eyes in space or time, else the display's own.
[[nodiscard]] Shown flat(const ChannelPicture& picture);

// Writes folder/channel-NAME.png, the picture of the display, and in stereo
// channel-NAME.left_eye.png and .right_eye.png beside it; creates the folder. Throws Error where
// they cannot be written.
void writeSnapshot(const std::string& folder,
                   const std::string& channel,
                   ChannelPicture& picture,
                   PictureBits bits);

}  // namespace aquarama::show
