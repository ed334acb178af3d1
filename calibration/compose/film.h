// SPDX-License-Identifier: Apache-2.0
// Makes a clip of the wall while nodes draw it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "common/config/rig.h"

namespace aquarama::compose {

// The names of views, beside the names of channels.
inline constexpr const char* kPanorama = "panorama";
inline constexpr const char* kHall = "hall";

// The view that is filmed, and the files of the clip.
struct Filming {
    std::string of = kPanorama;   // or kHall, or a channel's name
    std::filesystem::path pipes;  // folder of the sockets by which the nodes send frames
    std::string clipPath;         // .mp4 or .webp
    int ticksBetween = 1;
    std::optional<std::uint64_t> frames = {};  // of the show, where it is known
    // The frame of the whole film at which this part of it begins.
    std::uint64_t fromFrame = 0;
    // Folder for panorama.png and hall.png of the first frame, written at once, where the panorama
    // or the hall is filmed; empty: none.
    std::string firstPictures = {};
};

// Makes the clip until a node ends, and writes one line about it. Shows its progress. Throws Error
// for frames that do not fit the rig or differ between channels, without any frame, and where the
// clip cannot be written.
void film(const config::Rig& rig, const Filming& filming);

// Pictures that one program draws, and the clip that they become.
struct SentPictures {
    std::filesystem::path pipe;  // the socket by which it sends them
    std::string clipPath;        // .mp4 or .webp
    int ticksBetween = 1;        // ticks of 1/60 s for which each is shown
};

// Makes the clip until the sender ends. Throws Error without any picture, for pictures of different
// sizes, and where the clip cannot be written.
void encode(const SentPictures& sent);

}  // namespace aquarama::compose
