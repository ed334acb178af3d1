// SPDX-License-Identifier: Apache-2.0
// A moving picture in a file: MP4 by FFmpeg's libraries, or a looping animated WebP.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include <glm/vec2.hpp>

#include "common/base/picture.h"

namespace aquarama::compose {

// Of a clip that is to be made.
struct ClipFormat {
    std::string path;  // its ending chooses: .mp4 or .webp
    glm::ivec2 sizePixels{};
    int ticksBetween = 1;  // frames of a show from one picture of the clip to the next
};

// A clip that is being made: an OutputFile until finish(). The functions throw Error where the file
// cannot be written.
class Clip {
  public:
    virtual ~Clip() = default;
    // The next picture: codes of 8 bits, of the format's size. Ticks count up; the first may be
    // any.
    virtual void add(const Picture& picture, std::uint64_t tick) = 0;
    // Once, after the last. The last picture is seen as long as the others.
    virtual void finish() = 0;
};

// FFmpeg's names of the encoders for MP4, best first: H.264, which every player knows; VP9; MPEG-4
// part 2, which every build of the library has.
[[nodiscard]] std::span<const char* const> videoEncoders();

// By the ending of the path. Throws Error: another ending, a file that cannot be written, no
// encoder.
[[nodiscard]] std::unique_ptr<Clip> makeClip(const ClipFormat& format);
// By the first of these encoders that the library has and that opens.
[[nodiscard]] std::unique_ptr<Clip> makeVideo(const ClipFormat& format,
                                              std::span<const char* const> encoders);
[[nodiscard]] std::unique_ptr<Clip> makeAnimation(const ClipFormat& format);

}  // namespace aquarama::compose
