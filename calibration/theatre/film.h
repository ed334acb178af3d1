// SPDX-License-Identifier: Apache-2.0
// A clip of the wall, composed while nodes draw it.
#pragma once

#include <filesystem>
#include <string>

#include "common/config/rig.h"

namespace aquarama {

// What a clip shows beside channels by their names.
inline constexpr const char* kPanorama = "panorama";
inline constexpr const char* kHall = "hall";

struct Filming {
    std::string of = kPanorama;   // or kHall, or a channel's name
    std::filesystem::path pipes;  // folder with a named pipe for each channel that is filmed
    std::string clipPath;         // .mp4 or .webp
    int ticksBetween = 1;
};

// Until the nodes close their pipes. Throws Error: frames that are not the rig's or not the same
// ones of all channels, no frame at all, a clip that cannot be written.
void film(const Rig& rig, const Filming& filming);

}  // namespace aquarama
