// SPDX-License-Identifier: Apache-2.0
// A folder of what the projectors show, and the two pictures that are composed of it.
#pragma once

#include <string>
#include <vector>

#include "common/config/rig.h"
#include "common/wall/picture.h"

namespace aquarama::theatre {

// What every channel of folder/channel-NAME.png throws on the wall, seen without glasses: of two
// eyes that its display parts again the mean of channel-NAME.left_eye.png and .right_eye.png.
// Throws Error when a picture is missing or has not its channel's size.
[[nodiscard]] std::vector<wall::Light> readChannels(const config::Rig& rig,
                                                    const std::string& folder);

// Writes folder/panorama.png and folder/hall.png. Throws Error where they cannot be written.
void writePanoramaAndHall(const config::Rig& rig,
                          const wall::Light& panorama,
                          const std::string& folder,
                          int bits);

// Composes folder/panorama.png and folder/hall.png, and in stereo panorama.left_eye.png and
// .right_eye.png, of the channels' pictures there.
// Throws Error when a picture is missing or has not its channel's size.
void composeSnapshot(const config::Rig& rig, const std::string& folder, int bits);

}  // namespace aquarama::theatre
