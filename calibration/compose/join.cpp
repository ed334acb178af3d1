// SPDX-License-Identifier: Apache-2.0
#include "calibration/compose/join.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

extern "C" {
#include <libavformat/avformat.h>
}

#include "calibration/compose/video_file.h"
#include "common/base/log.h"
#include "common/cli/outputs.h"

namespace aquarama::compose {

namespace {

struct FreeInput {
    void operator()(AVFormatContext* file) const { avformat_close_input(&file); }
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
};

// A clip that is read packet by packet.
class OpenClip {
  public:
    // Throws Error where it is no MP4 of one video.
    explicit OpenClip(const std::string& path) : path_{path} {
        AVFormatContext* opened = nullptr;
        const std::string url = "file:" + path;
        if (avformat_open_input(&opened, url.c_str(), av_find_input_format("mov"), nullptr) < 0)
            refuse("cannot be read as a clip");
        file_.reset(opened);
        // The pictures' format is not in the head of every file.
        if (avformat_find_stream_info(opened, nullptr) < 0) refuse("cannot be read as a clip");
        if (file_->nb_streams != 1 || codec().codec_type != AVMEDIA_TYPE_VIDEO)
            refuse("is not a clip of one video");
    }
    [[nodiscard]] const AVCodecParameters& codec() const { return *file_->streams[0]->codecpar; }
    // Whether there is another packet, with its times in ticks from the clip's beginning.
    [[nodiscard]] bool next(AVPacket& packet) {
        const int read = av_read_frame(file_.get(), &packet);
        if (read == AVERROR_EOF) return false;
        if (read < 0) refuse("is damaged or cut off");
        av_packet_rescale_ts(&packet, file_->streams[0]->time_base, kTick);
        return true;
    }
    [[noreturn]] void refuse(const std::string& why) const {
        throw Error(path_ + ": " + why + "; make this part again");
    }

  private:
    std::string path_;
    std::unique_ptr<AVFormatContext, FreeInput> file_;
};

// What the file's head says to decoders.
std::span<const std::uint8_t> headOf(const AVCodecParameters& codec) {
    return {codec.extradata, static_cast<std::size_t>(codec.extradata_size)};
}

bool isAlike(const AVCodecParameters& one, const AVCodecParameters& other) {
    return one.codec_id == other.codec_id && one.width == other.width &&
           one.height == other.height && std::ranges::equal(headOf(one), headOf(other));
}

// The clips as they are appended to one file.
class Joined {
  public:
    Joined(const std::string& out, int ticksBetween)
        : out_{out}, ticksBetween_{ticksBetween}, packet_{av_packet_alloc()} {}
    void append(OpenClip& clip) {
        std::int64_t end = end_;
        while (clip.next(*packet_)) {
            if (!file_) file_.emplace(out_, clip.codec(), ticksBetween_);
            packet_->pts += end_;
            packet_->dts += end_;
            end = std::max(end, packet_->pts + ticksBetween_);
            file_->write(*packet_);
        }
        end_ = end;
    }
    void finish() {
        if (!file_) throw Error(out_ + ": the clips have no pictures; make the parts again");
        file_->finish();
    }

  private:
    std::string out_;
    int ticksBetween_;
    std::unique_ptr<AVPacket, FreeInput> packet_;
    std::optional<VideoFile> file_;
    std::int64_t end_ = 0;  // of what was appended, in ticks
};

}  // namespace

void join(const JoinedClips& joining) {
    const std::vector<std::string>& clips = joining.clips;
    assert(!clips.empty());
    av_log_set_level(AV_LOG_FATAL);
    requireMp4();
    const OpenClip first(clips.front());
    Joined joined(joining.out, joining.ticksBetween);
    for (const std::string& path : clips) {
        OpenClip clip(path);
        if (!isAlike(clip.codec(), first.codec()))
            clip.refuse("has another size or encoder than " + clips.front());
        joined.append(clip);
    }
    joined.finish();
    cli::say(joining.out);
}

}  // namespace aquarama::compose
