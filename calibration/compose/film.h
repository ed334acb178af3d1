// SPDX-License-Identifier: Apache-2.0
// A clip of the wall, composed while nodes draw it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "common/config/rig.h"

namespace aquarama::compose {

// What a clip shows beside channels by their names.
inline constexpr const char* kPanorama = "panorama";
inline constexpr const char* kHall = "hall";

// What is filmed, and into which files.
struct Filming {
    std::string of = kPanorama;   // or kHall, or a channel's name
    std::filesystem::path pipes;  // folder of the sockets by which the nodes send frames
    std::string clipPath;         // .mp4 or .webp
    int ticksBetween = 1;
    std::optional<std::uint64_t> frames = {};  // of the show, where it is known
    // Of the panorama or the hall: where panorama.png and hall.png of the first frame go, at once;
    // empty: nowhere.
    std::string firstPictures = {};
};

// Makes the clip until a node has ended, and says what it made. Shows its progress on standard
// output: in one line of a terminal, or a line every ten seconds. Throws Error: frames that are not
// the rig's or not the same ones of all channels, no frame at all, a clip that cannot be written.
void film(const config::Rig& rig, const Filming& filming);

}  // namespace aquarama::compose
