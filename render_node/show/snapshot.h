// SPDX-License-Identifier: Apache-2.0
// Pictures of what a channel projects.
#pragma once

#include <string>

#include "common/wall/picture.h"
#include "render_node/show/channel_picture.h"

namespace aquarama {

enum class PictureBits : std::uint8_t { Dithered8, Deep16 };

// The frame that was drawn last, without overlays.
[[nodiscard]] Picture takePicture(ChannelPicture& picture, PictureBits bits);

// folder/channel-NAME.png: the frame that was drawn last, without overlays. Throws Error where it
// cannot be written.
void writeSnapshot(const std::string& folder,
                   const std::string& channel,
                   ChannelPicture& picture,
                   PictureBits bits);

}  // namespace aquarama
