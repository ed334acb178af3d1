// SPDX-License-Identifier: Apache-2.0
// Writes clips: MP4 by FFmpeg's libraries, or a looping animated WebP.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include <glm/vec2.hpp>

#include "common/base/picture.h"

namespace aquarama::compose {

// The format of a clip.
struct ClipFormat {
    std::string path;  // its ending chooses: .mp4 or .webp
    glm::ivec2 sizePixels{};
    int ticksBetween = 1;  // frames of the show for each picture of the clip
};

// A clip that is being made: an OutputFile until finish(). The functions throw Error where the file
// cannot be written.
class Clip {
  public:
    virtual ~Clip() = default;
    // Adds the next picture: codes of 8 bits, of the format's size. Ticks increase from any number.
    virtual void add(const Picture& picture, std::uint64_t tick) = 0;
    // Completes the file; call it once. The last picture is shown as long as the others.
    virtual void finish() = 0;
};

// FFmpeg's names of the encoders for MP4, best first: H.264, which every player knows; VP9; MPEG-4
// part 2, which every build of the library has.
[[nodiscard]] std::span<const char* const> videoEncoders();

// Chooses by the ending of the path. Throws Error for another ending, for a file that cannot be
// written, and without an encoder.
[[nodiscard]] std::unique_ptr<Clip> makeClip(const ClipFormat& format);
// Uses the first of these encoders that the library has and that opens.
[[nodiscard]] std::unique_ptr<Clip> makeVideo(const ClipFormat& format,
                                              std::span<const char* const> encoders);
[[nodiscard]] std::unique_ptr<Clip> makeAnimation(const ClipFormat& format);

}  // namespace aquarama::compose
