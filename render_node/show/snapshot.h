// SPDX-License-Identifier: Apache-2.0
// Pictures of what a channel projects.
#pragma once

#include <string>

#include "common/wall/picture.h"
#include "render_node/show/channel_picture.h"

namespace aquarama::show {

enum class PictureBits : std::uint8_t { Dithered8, Deep16 };

// The frame that was drawn last, without overlays.
[[nodiscard]] wall::Picture takePicture(ChannelPicture& picture, PictureBits bits, Shown shown);

// What somebody without glasses may look at: one eye's picture where a display takes the two apart
// from one another.
[[nodiscard]] Shown flat(const ChannelPicture& picture);

// folder/channel-NAME.png: takePicture() of the display, and in stereo channel-NAME.left_eye.png
// and .right_eye.png beside it. Throws Error where they cannot be written.
void writeSnapshot(const std::string& folder,
                   const std::string& channel,
                   ChannelPicture& picture,
                   PictureBits bits);

}  // namespace aquarama::show
