// SPDX-License-Identifier: Apache-2.0
// MP4 files of one video: the packets of an encoder, or those of other such files once more.
#pragma once

#include <memory>
#include <string>

extern "C" {
#include <libavcodec/avcodec.h>
}

#include "common/base/units.h"

namespace aquarama::compose {

// The unit of times: a sixtieth of a second.
inline constexpr AVRational kTick{1, static_cast<int>(kTicksPerSecond)};

// Throws Error where this build of FFmpeg's libraries writes no MP4.
void requireMp4();

// An MP4 file that is being written; it appears when it is finished. The functions throw Error
// where it cannot be written.
class VideoFile {
  public:
    // `ticksBetween` two pictures. Begins the file.
    VideoFile(const std::string& path, const AVCodecParameters& codec, int ticksBetween);
    ~VideoFile();
    // Takes the packet's content; its times are in ticks.
    void write(AVPacket& packet);
    // Completes the file. Call it once, after the last packet.
    void finish();
    // Throws Error for a result of the libraries that is an error.
    void check(int result) const;

  private:
    struct Output;

    std::string path_;
    int ticksBetween_;
    std::unique_ptr<Output> output_;
};

}  // namespace aquarama::compose
