// SPDX-License-Identifier: Apache-2.0
#include "calibration/compose/video_file.h"

#include <array>
#include <cstdint>
#include <exception>
#include <span>

extern "C" {
#include <libavformat/avformat.h>
}

#include "common/base/log.h"
#include "common/base/output_file.h"

namespace aquarama::compose {

namespace {

std::string reason(int error) {
    std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
    av_strerror(error, text.data(), text.size());
    return text.data();
}

struct FreeOutput {
    void operator()(AVFormatContext* file) const { avformat_free_context(file); }
    void operator()(AVIOContext* stream) const {
        av_freep(&stream->buffer);
        avio_context_free(&stream);
    }
};
template <class Owned>
using OutputOwner = std::unique_ptr<Owned, FreeOutput>;

OutputOwner<AVFormatContext> newMp4() {
    AVFormatContext* made = nullptr;
    avformat_alloc_output_context2(&made, nullptr, "mp4", nullptr);
    return OutputOwner<AVFormatContext>{made};
}

// What FFmpeg's libraries write goes through our file: they call these functions, which must not
// throw, so an error waits until rethrow().
class VideoStream {
  public:
    explicit VideoStream(const std::string& path) : file_{path} {
        constexpr int kBufferBytes = 1 << 16;
        auto* const buffer = static_cast<unsigned char*>(av_malloc(kBufferBytes));
        stream_.reset(avio_alloc_context(
            buffer, kBufferBytes, 1, this, nullptr, take, file_.canSeek() ? seek : nullptr));
        if (!stream_) throw Error("a clip cannot be made: no memory");
        stream_->seekable = file_.canSeek() ? AVIO_SEEKABLE_NORMAL : 0;
    }
    [[nodiscard]] AVIOContext* get() const { return stream_.get(); }
    [[nodiscard]] const OutputFile& file() const { return file_; }
    void rethrow() const {
        if (failure_) std::rethrow_exception(failure_);
    }
    void finish() {
        avio_flush(stream_.get());
        rethrow();
        file_.finish();
    }

  private:
    // Later versions of the library give bytes that are const.
    template <class Byte>
    static int take(void* self, Byte* bytes, int count) {
        return static_cast<VideoStream*>(self)->take(
            std::as_bytes(std::span(bytes, static_cast<std::size_t>(count))));
    }
    int take(std::span<const std::byte> bytes) {
        try {
            if (file_.canSeek())
                file_.writeAt(at_, bytes);
            else
                file_.write(bytes);
        } catch (const Error&) {
            failure_ = std::current_exception();
            return AVERROR(EIO);
        }
        at_ += bytes.size();
        return static_cast<int>(bytes.size());
    }
    // From the beginning only: no other is asked for, but for the size, which is not known.
    static std::int64_t seek(void* self, std::int64_t offset, int whence) {
        if (whence != SEEK_SET || offset < 0) return AVERROR(ENOSYS);
        static_cast<VideoStream*>(self)->at_ = static_cast<std::uint64_t>(offset);
        return offset;
    }

    OutputFile file_;
    std::uint64_t at_ = 0;
    std::exception_ptr failure_;
    OutputOwner<AVIOContext> stream_;
};

}  // namespace

// The file is freed before its stream.
struct VideoFile::Output {
    explicit Output(const std::string& path) : stream{path}, file{newMp4()} {}

    VideoStream stream;
    OutputOwner<AVFormatContext> file;
    AVStream* video = nullptr;
};

void requireMp4() {
    if (!newMp4())
        throw Error("this build of FFmpeg's libraries writes no MP4; install libavformat59");
}

VideoFile::VideoFile(const std::string& path, const AVCodecParameters& codec, int ticksBetween)
    : path_{path}, ticksBetween_{ticksBetween}, output_{std::make_unique<Output>(path)} {
    AVFormatContext& file = *output_->file;
    AVStream& video = *(output_->video = avformat_new_stream(&file, nullptr));
    video.time_base = kTick;
    video.avg_frame_rate = {kTick.den, ticksBetween};
    avcodec_parameters_copy(video.codecpar, &codec);
    video.codecpar->codec_tag = 0;
    video.codecpar->bit_rate = 0;  // what it will be is not known; the file tells what it is
    const OutputFile& written = output_->stream.file();
    file.pb = output_->stream.get();
    file.url = av_strdup(written.writtenPath().c_str());  // read to put the index first
    // Plays before all of it has come; in a pipe the index cannot be put first.
    AVDictionary* options = nullptr;
    av_dict_set(&options,
                "movflags",
                written.canSeek() ? "+faststart" : "+frag_keyframe+empty_moov+default_base_moof",
                0);
    const int begun = avformat_write_header(&file, &options);
    av_dict_free(&options);
    check(begun);
}

VideoFile::~VideoFile() = default;

void VideoFile::write(AVPacket& packet) {
    packet.duration = ticksBetween_;
    packet.stream_index = output_->video->index;
    av_packet_rescale_ts(&packet, kTick, output_->video->time_base);
    check(av_interleaved_write_frame(output_->file.get(), &packet));
}

void VideoFile::finish() {
    check(av_write_trailer(output_->file.get()));
    output_->stream.finish();
}

void VideoFile::check(int result) const {
    output_->stream.rethrow();
    if (result < 0)
        throw Error(path_ + ": a clip cannot be made (" + reason(result) + "); choose FILE.webp");
}

}  // namespace aquarama::compose
