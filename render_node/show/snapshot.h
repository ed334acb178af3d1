// SPDX-License-Identifier: Apache-2.0
// Pictures of what a channel projects.
#pragma once

#include <string>

#include "common/units/ids.h"
#include "render_node/show/channel_picture.h"

namespace aquarama {

enum class PictureBits : std::uint8_t { Dithered8, Deep16 };

// folder/channel-NAME.png: the frame that was drawn last, without overlays. Throws Error where it
// cannot be written.
void writeSnapshot(const std::string& folder,
                   const std::string& channel,
                   ChannelPicture& picture,
                   PictureBits bits);

// Each frame of a film is a folder of snapshots: folder/film/000012.
[[nodiscard]] std::string filmFolder(const std::string& folder, Frame frame);

}  // namespace aquarama
