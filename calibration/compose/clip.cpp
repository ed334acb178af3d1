// SPDX-License-Identifier: Apache-2.0
// Two makers of clips: animated WebP, which web pages and documents show like any picture, and MP4
// by FFmpeg's libraries.
#include "calibration/compose/clip.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <optional>
#include <vector>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/imgutils.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}
#include <webp/encode.h>
#include <webp/mux.h>

#include "calibration/compose/video_file.h"
#include "common/base/log.h"
#include "common/base/output_file.h"
#include "common/base/units.h"
#include "common/parts/part.h"

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
struct FreeEncoding {
    void operator()(AVCodecContext* encoder) const { avcodec_free_context(&encoder); }
    void operator()(AVCodecParameters* codec) const { avcodec_parameters_free(&codec); }
    void operator()(AVFrame* frame) const { av_frame_free(&frame); }
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
    void operator()(SwsContext* converter) const { sws_freeContext(converter); }
};
template <class Owned>
using Owner = std::unique_ptr<Owned, FreeEncoding>;

// Colours have half the resolution each way, so both sizes must be even: the last column or row is
// doubled where they are not.
glm::ivec2 evenSize(glm::ivec2 size) {
    return (size + 1) / 2 * 2;
}

// For each encoder, so good that noise of one code and dark gradients stay as they are.
void chooseQuality(AVCodecContext& encoder) {
    av_opt_set(encoder.priv_data, "crf", "18", 0);     // H.264: hardly to be told from the original
    av_opt_set(encoder.priv_data, "aq-mode", "3", 0);  // H.264: bits for what is dark
    // H.264: the same bits each time and on every machine. Without, one run of some was another,
    // by an estimate that its fastest code makes.
    av_opt_set(encoder.priv_data, "x264-params", "cpu-independent=1", 0);
    av_opt_set(encoder.priv_data, "deadline", "good", 0);  // VP9
    av_opt_set(encoder.priv_data, "cpu-used", "4", 0);
    const std::string name = encoder.codec->name;
    if (name == "libvpx-vp9") av_opt_set(encoder.priv_data, "crf", "24", 0);
    if (name == "mpeg4") {
        encoder.flags |= AV_CODEC_FLAG_QSCALE;
        encoder.global_quality = 3 * FF_QP2LAMBDA;
    }
}

// What an encoder writes depends on the number of its threads: the same on every machine.
constexpr int kThreads = 8;

Owner<AVCodecContext> openEncoder(const char* name, const ClipFormat& format) {
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
    encoder->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;  // as MP4 wants it
    encoder->thread_count = kThreads;
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

// Frames are converted, encoded and written one by one.
class Video final : public Clip {
  public:
    Video(const ClipFormat& format, std::span<const char* const> encoders)
        : format_{format}, packet_{av_packet_alloc()} {
        av_log_set_level(AV_LOG_FATAL);
        requireMp4();
        open(encoders);
        const Owner<AVCodecParameters> codec{avcodec_parameters_alloc()};
        avcodec_parameters_from_context(codec.get(), encoder_.get());
        file_.emplace(format.path, *codec, format.ticksBetween);
        makeFrame();
    }
    void add(const Picture& picture, std::uint64_t tick) override {
        assert(picture.sizePixels == format_.sizePixels);
        if (!first_) first_ = tick;
        if (pictures_ > 0 && pictures_ % parts::kPicturesOfPiece == 0) beginPiece();
        ++pictures_;
        fillFrame(picture);
        frame_->pts = static_cast<std::int64_t>(tick - *first_);
        encode(frame_.get());
    }

    void finish() override {
        encode(nullptr);
        file_->finish();
    }

  private:
    void open(std::span<const char* const> encoders) {
        std::string tried;
        for (const char* name : encoders) {
            encoder_ = openEncoder(name, format_);
            if (encoder_) return;
            tried += tried.empty() ? name : std::string(", ") + name;
        }
        throw Error(format_.path + ": this build of FFmpeg's libraries has none of the encoders " +
                    tried + "; install libavcodec59, or write FILE.webp");
    }

    // Ends the piece before and begins another, which knows nothing of it: so the pieces of a film
    // are the same whether one machine encodes them or several do.
    void beginPiece() {
        encode(nullptr);
        encoder_ = openEncoder(encoder_->codec->name, format_);
        if (!encoder_) file_->check(AVERROR(ENOMEM));
    }

    void makeFrame() {
        const glm::ivec2 size = evenSize(format_.sizePixels);
        converter_ = makeConverter(size);
        frame_.reset(av_frame_alloc());
        frame_->format = kPixels;
        frame_->width = size.x;
        frame_->height = size.y;
        file_->check(av_frame_get_buffer(frame_.get(), 0));
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
        file_->check(av_frame_make_writable(frame_.get()));
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
        file_->check(avcodec_send_frame(encoder_.get(), frame));
        while (true) {
            const int received = avcodec_receive_packet(encoder_.get(), packet_.get());
            if (received == AVERROR(EAGAIN) || received == AVERROR_EOF) return;
            file_->check(received);
            file_->write(*packet_);
        }
    }

    ClipFormat format_;
    std::optional<VideoFile> file_;
    Owner<AVCodecContext> encoder_;
    Owner<AVPacket> packet_;
    Owner<AVFrame> frame_;
    Owner<SwsContext> converter_;
    std::vector<std::uint8_t> rgb_;
    std::uint64_t pictures_ = 0;
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
