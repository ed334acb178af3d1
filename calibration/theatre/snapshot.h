// SPDX-License-Identifier: Apache-2.0
// A folder of what the projectors show, and the two pictures that are composed of it.
#pragma once

#include <string>
#include <vector>

#include "common/config/rig.h"
#include "common/wall/picture.h"

namespace aquarama {

// folder/channel-NAME.png of every channel, as light. Throws Error when a picture is missing or has
// not its channel's size.
[[nodiscard]] std::vector<Light> readChannels(const Rig& rig, const std::string& folder);

// Reads folder/channel-NAME.png of every channel, writes folder/panorama.png and folder/hall.png.
// Throws Error when a picture is missing or has not its channel's size.
void composeSnapshot(const Rig& rig, const std::string& folder, int bits);

}  // namespace aquarama
