// SPDX-License-Identifier: Apache-2.0
// Two makers of clips: animated WebP, which web pages and documents show like any picture, and MP4
// by FFmpeg's libraries.
#include "calibration/compose/clip.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <exception>
#include <optional>
#include <vector>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/imgutils.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}
#include <webp/encode.h>
#include <webp/mux.h>

#include "common/base/log.h"
#include "common/base/output_file.h"
#include "common/base/units.h"

namespace aquarama::compose {

namespace {

constexpr float kQuality = 80.0F;  // of 100: no block is seen at the size of a window
constexpr int kEffort = 3;         // of 6

// Frames go to the encoder one by one; the file is assembled at the end.
class Animation final : public Clip {
  public:
    explicit Animation(const ClipFormat& format) : format_{format}, file_{format.path} {
        WebPAnimEncoderOptions options;
        WebPAnimEncoderOptionsInit(&options);
        options.minimize_size = 0;
        encoder_.reset(WebPAnimEncoderNew(format.sizePixels.x, format.sizePixels.y, &options));
        if (!encoder_)
            throw Error("a clip cannot be made: no memory, or its pictures are too large");
    }
    void add(const Picture& picture, std::uint64_t tick) override {
        assert(picture.sizePixels == format_.sizePixels);
        assert((!first_ || tick > last_));
        if (!first_) first_ = tick;
        last_ = tick;
        std::vector<std::uint8_t> rgb(picture.rgb.begin(), picture.rgb.end());
        WebPConfig config;
        WebPConfigInit(&config);
        config.quality = kQuality;
        config.method = kEffort;
        WebPPicture frame;
        WebPPictureInit(&frame);
        frame.use_argb = 1;
        frame.width = format_.sizePixels.x;
        frame.height = format_.sizePixels.y;
        const bool added =
            WebPPictureImportRGB(&frame, rgb.data(), 3 * frame.width) != 0 &&
            WebPAnimEncoderAdd(encoder_.get(), &frame, millisecondsOf(tick), &config) != 0;
        WebPPictureFree(&frame);
        if (!added)
            throw Error(std::string("a clip cannot be made: ") +
                        WebPAnimEncoderGetError(encoder_.get()));
    }

    void finish() override {
        const int end = millisecondsOf(last_ + static_cast<std::uint64_t>(format_.ticksBetween));
        WebPAnimEncoderAdd(encoder_.get(), nullptr, end, nullptr);
        WebPData data;
        WebPDataInit(&data);
        const bool assembled = WebPAnimEncoderAssemble(encoder_.get(), &data) != 0;
        const std::vector<std::uint8_t> bytes(data.bytes, data.bytes + data.size);
        WebPDataClear(&data);
        if (!assembled)
            throw Error(std::string("a clip cannot be made: ") +
                        WebPAnimEncoderGetError(encoder_.get()));
        file_.reserve(bytes.size());
        file_.write(std::as_bytes(std::span(bytes)));
        file_.finish();
    }

  private:
    struct Delete {
        void operator()(WebPAnimEncoder* encoder) const { WebPAnimEncoderDelete(encoder); }
    };
    [[nodiscard]] int millisecondsOf(std::uint64_t tick) const {
        return static_cast<int>(1000.0 * static_cast<double>(tick - *first_) / kTicksPerSecond);
    }

    ClipFormat format_;
    OutputFile file_;
    std::unique_ptr<WebPAnimEncoder, Delete> encoder_;
    std::optional<std::uint64_t> first_;
    std::uint64_t last_ = 0;
};

constexpr AVPixelFormat kPixels = AV_PIX_FMT_YUV420P;  // what every player shows
// Exact: the fast conversions of the library are two codes off.
constexpr int kConversion =
    SWS_BILINEAR | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INP | SWS_FULL_CHR_H_INT;
constexpr AVRational kTick{1, static_cast<int>(kTicksPerSecond)};

struct Free {
    void operator()(AVCodecContext* encoder) const { avcodec_free_context(&encoder); }
    void operator()(AVFrame* frame) const { av_frame_free(&frame); }
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
    void operator()(SwsContext* converter) const { sws_freeContext(converter); }
    void operator()(AVFormatContext* file) const { avformat_free_context(file); }
    void operator()(AVIOContext* stream) const {
        av_freep(&stream->buffer);
        avio_context_free(&stream);
    }
};
template <class Owned>
using Owner = std::unique_ptr<Owned, Free>;

std::string reason(int error) {
    std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
    av_strerror(error, text.data(), text.size());
    return text.data();
}

// Colours have half the resolution each way, so both sizes must be even: the last column or row is
// doubled where they are not.
glm::ivec2 evenSize(glm::ivec2 size) {
    return (size + 1) / 2 * 2;
}

// For each encoder, so good that noise of one code and dark gradients stay as they are.
void chooseQuality(AVCodecContext& encoder) {
    av_opt_set(encoder.priv_data, "crf", "18", 0);     // H.264: hardly to be told from the original
    av_opt_set(encoder.priv_data, "aq-mode", "3", 0);  // H.264: bits for what is dark
    av_opt_set(encoder.priv_data, "deadline", "good", 0);  // VP9
    av_opt_set(encoder.priv_data, "cpu-used", "4", 0);
    const std::string name = encoder.codec->name;
    if (name == "libvpx-vp9") av_opt_set(encoder.priv_data, "crf", "24", 0);
    if (name == "mpeg4") {
        encoder.flags |= AV_CODEC_FLAG_QSCALE;
        encoder.global_quality = 3 * FF_QP2LAMBDA;
    }
}

Owner<AVCodecContext> openEncoder(const char* name, const ClipFormat& format, bool headerInFile) {
    const AVCodec* codec = avcodec_find_encoder_by_name(name);
    if (codec == nullptr) return nullptr;
    Owner<AVCodecContext> encoder{avcodec_alloc_context3(codec)};
    const glm::ivec2 size = evenSize(format.sizePixels);
    encoder->width = size.x;
    encoder->height = size.y;
    encoder->pix_fmt = kPixels;
    encoder->time_base = kTick;
    encoder->framerate = {kTick.den, format.ticksBetween};
    encoder->colorspace = AVCOL_SPC_BT709;
    encoder->color_primaries = AVCOL_PRI_BT709;
    encoder->color_trc = AVCOL_TRC_IEC61966_2_1;  // of our codes: sRGB
    encoder->color_range = AVCOL_RANGE_MPEG;
    if (headerInFile) encoder->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
    chooseQuality(*encoder);
    if (avcodec_open2(encoder.get(), codec, nullptr) < 0) return nullptr;
    return encoder;
}

// From codes of red, green and blue, as Rec. 709 has it.
Owner<SwsContext> makeConverter(glm::ivec2 size) {
    Owner<SwsContext> converter{sws_getContext(size.x,
                                               size.y,
                                               AV_PIX_FMT_RGB24,
                                               size.x,
                                               size.y,
                                               kPixels,
                                               kConversion,
                                               nullptr,
                                               nullptr,
                                               nullptr)};
    const int* rec709 = sws_getCoefficients(SWS_CS_ITU709);
    sws_setColorspaceDetails(converter.get(), rec709, 1, rec709, 0, 0, 1 << 16, 1 << 16);
    return converter;
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
    Owner<AVIOContext> stream_;
};

// Frames are converted, encoded and written one by one.
class Video final : public Clip {
  public:
    Video(const ClipFormat& format, std::span<const char* const> encoders)
        : format_{format}, packet_{av_packet_alloc()} {
        av_log_set_level(AV_LOG_FATAL);
        AVFormatContext* made = nullptr;
        avformat_alloc_output_context2(&made, nullptr, "mp4", nullptr);
        if (made == nullptr)
            throw Error("this build of FFmpeg's libraries writes no MP4; install libavformat59");
        file_.reset(made);
        open(encoders);
        start();
        makeFrame();
    }
    void add(const Picture& picture, std::uint64_t tick) override {
        assert(picture.sizePixels == format_.sizePixels);
        if (!first_) first_ = tick;
        fillFrame(picture);
        frame_->pts = static_cast<std::int64_t>(tick - *first_);
        encode(frame_.get());
    }

    void finish() override {
        encode(nullptr);
        check(av_write_trailer(file_.get()));
        written_->finish();
    }

  private:
    void open(std::span<const char* const> encoders) {
        const bool header = (file_->oformat->flags & AVFMT_GLOBALHEADER) != 0;
        std::string tried;
        for (const char* name : encoders) {
            encoder_ = openEncoder(name, format_, header);
            if (encoder_) return;
            tried += tried.empty() ? name : std::string(", ") + name;
        }
        throw Error(format_.path + ": this build of FFmpeg's libraries has none of the encoders " +
                    tried + "; install libavcodec59, or write FILE.webp");
    }

    void start() {
        stream_ = avformat_new_stream(file_.get(), nullptr);
        stream_->time_base = kTick;
        stream_->avg_frame_rate = encoder_->framerate;
        avcodec_parameters_from_context(stream_->codecpar, encoder_.get());
        written_ = std::make_unique<VideoStream>(format_.path);
        file_->pb = written_->get();
        file_->url =
            av_strdup(written_->file().writtenPath().c_str());  // read to put the index first
        // Plays before all of it has come; in a pipe the index cannot be put first.
        const bool isPipe = !written_->file().canSeek();
        AVDictionary* options = nullptr;
        av_dict_set(&options,
                    "movflags",
                    isPipe ? "+frag_keyframe+empty_moov+default_base_moof" : "+faststart",
                    0);
        const int written = avformat_write_header(file_.get(), &options);
        av_dict_free(&options);
        check(written);
    }

    void makeFrame() {
        const glm::ivec2 size = evenSize(format_.sizePixels);
        converter_ = makeConverter(size);
        frame_.reset(av_frame_alloc());
        frame_->format = kPixels;
        frame_->width = size.x;
        frame_->height = size.y;
        check(av_frame_get_buffer(frame_.get(), 0));
        rgb_.resize(3 * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    }

    void fillFrame(const Picture& picture) {
        const glm::ivec2 size = evenSize(format_.sizePixels);
        const glm::ivec2 last = picture.sizePixels - 1;
        auto* out = rgb_.data();
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                const auto from = static_cast<std::size_t>(std::min(y, last.y)) *
                                      static_cast<std::size_t>(picture.sizePixels.x) +
                                  static_cast<std::size_t>(std::min(x, last.x));
                for (std::size_t c = 0; c < 3; ++c)
                    *out++ = static_cast<std::uint8_t>(picture.rgb[3 * from + c]);
            }
        check(av_frame_make_writable(frame_.get()));
        const std::array<const std::uint8_t*, 1> planes{rgb_.data()};
        const std::array<int, 1> strides{3 * size.x};
        sws_scale(converter_.get(),
                  planes.data(),
                  strides.data(),
                  0,
                  size.y,
                  frame_->data,
                  frame_->linesize);
    }

    void encode(const AVFrame* frame) {
        check(avcodec_send_frame(encoder_.get(), frame));
        while (true) {
            const int received = avcodec_receive_packet(encoder_.get(), packet_.get());
            if (received == AVERROR(EAGAIN) || received == AVERROR_EOF) return;
            check(received);
            packet_->duration = format_.ticksBetween;
            packet_->stream_index = stream_->index;
            av_packet_rescale_ts(packet_.get(), kTick, stream_->time_base);
            check(av_interleaved_write_frame(file_.get(), packet_.get()));
        }
    }

    void check(int result) const {
        if (written_) written_->rethrow();
        if (result < 0)
            throw Error(format_.path + ": a clip cannot be made (" + reason(result) +
                        "); choose FILE.webp");
    }

    ClipFormat format_;
    std::unique_ptr<VideoStream> written_;
    Owner<AVFormatContext> file_;
    Owner<AVCodecContext> encoder_;
    Owner<AVPacket> packet_;
    AVStream* stream_ = nullptr;  // the file's
    Owner<SwsContext> converter_;
    Owner<AVFrame> frame_;
    std::vector<std::uint8_t> rgb_;
    std::optional<std::uint64_t> first_;
};

constexpr std::array<const char*, 3> kEncoders{"libx264", "libvpx-vp9", "mpeg4"};

}  // namespace

std::span<const char* const> videoEncoders() {
    return kEncoders;
}

std::unique_ptr<Clip> makeVideo(const ClipFormat& format, std::span<const char* const> encoders) {
    assert(!encoders.empty());
    return std::make_unique<Video>(format, encoders);
}

std::unique_ptr<Clip> makeAnimation(const ClipFormat& format) {
    return std::make_unique<Animation>(format);
}

std::unique_ptr<Clip> makeClip(const ClipFormat& format) {
    assert(format.sizePixels.x > 0);
    assert(format.sizePixels.y > 0);
    assert(format.ticksBetween > 0);
    if (format.path.ends_with(".mp4")) return makeVideo(format, videoEncoders());
    if (format.path.ends_with(".webp")) return makeAnimation(format);
    throw Error(format.path + ": a clip is FILE.mp4 or FILE.webp; choose one of these endings");
}

}  // namespace aquarama::compose
