// SPDX-License-Identifier: Apache-2.0
// Cameras whose frames FFmpeg's libraries read, and the choice among all cameras.
#include "calibration/scan/camera.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavdevice/avdevice.h>
#include <libavformat/avformat.h>
}

#include "calibration/scan/camera_controls.h"
#include "calibration/scan/read_picture.h"
#include "common/base/log.h"

namespace aquarama::scan {

namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;  // CLOCK_MONOTONIC, as V4L2 dates its frames

constexpr std::string_view kVideo = "/dev/";
constexpr std::string_view kGraph = "lavfi:";
constexpr std::string_view kGphoto = "gphoto2:";

struct Free {
    void operator()(AVCodecContext* decoder) const { avcodec_free_context(&decoder); }
    void operator()(AVFrame* frame) const { av_frame_free(&frame); }
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
    void operator()(AVFormatContext* stream) const { avformat_close_input(&stream); }
};
template <class Owned>
using Owner = std::unique_ptr<Owned, Free>;

// The source that FFmpeg opens, and its options.
struct Source {
    std::string name;
    const AVInputFormat* format = nullptr;  // null: by its content
    std::string options;                    // key=value&key=value
    bool isLive = true;                     // gives its frames in real time by itself
};

// What follows a question mark is for V4L2 alone: addresses have theirs.
Source sourceOf(const std::string& device) {
    if (device.starts_with(kGraph))
        return {device.substr(kGraph.size()), av_find_input_format("lavfi"), "", false};
    if (!device.starts_with(kVideo))
        return {device, nullptr, "", device.find("://") != std::string::npos};
    const std::size_t mark = device.find('?');
    const std::string options = mark == std::string::npos ? "" : device.substr(mark + 1);
    return {device.substr(0, mark), av_find_input_format("video4linux2"), options, true};
}

Owner<AVFormatContext> openInput(const Source& source, const std::atomic<bool>& isOver) {
    AVFormatContext* made = avformat_alloc_context();
    made->flags |= AVFMT_FLAG_NOBUFFER;
    // Ends a wait for a camera that does not answer.
    made->interrupt_callback.callback = [](void* over) -> int {
        return *static_cast<const std::atomic<bool>*>(over) ? 1 : 0;
    };
    made->interrupt_callback.opaque = const_cast<std::atomic<bool>*>(&isOver);
    AVDictionary* options = nullptr;
    av_dict_parse_string(&options, source.options.c_str(), "=", "&", 0);
    const int opened = avformat_open_input(&made, source.name.c_str(), source.format, &options);
    const AVDictionaryEntry* unknown = av_dict_get(options, "", nullptr, AV_DICT_IGNORE_SUFFIX);
    const std::string left = unknown == nullptr ? "" : unknown->key;
    av_dict_free(&options);
    Owner<AVFormatContext> input(opened < 0 ? nullptr : made);
    if (input && !left.empty())
        throw Error(source.name + ": has no option \"" + left +
                    "\"; write options as in /dev/video0?video_size=1920x1080&framerate=30");
    const int found = input ? avformat_find_stream_info(input.get(), nullptr) : opened;
    // FFmpeg's own errors are of four letters, and larger than any of the system.
    constexpr int kMostOfSystem = 4096;
    if (found < 0)
        throw Error(deviceProblem(source.name, -found < kMostOfSystem ? AVUNERROR(found) : 0));
    return input;
}

// Null where FFmpeg has none for the stream.
Owner<AVCodecContext> openDecoder(const AVStream& stream) {
    const AVCodec* codec = avcodec_find_decoder(stream.codecpar->codec_id);
    Owner<AVCodecContext> decoder(codec == nullptr ? nullptr : avcodec_alloc_context3(codec));
    if (!decoder || avcodec_parameters_to_context(decoder.get(), stream.codecpar) < 0) return {};
    decoder->thread_count = 1;  // frames of several threads come late
    return avcodec_open2(decoder.get(), codec, nullptr) == 0 ? std::move(decoder) : nullptr;
}

// Frames of a source, one after the other. For one thread.
class FrameReader {
  public:
    FrameReader(const Source& source, const std::atomic<bool>& isOver)
        : name_{source.name},
          isLive_{source.isLive},
          input_{openInput(source, isOver)},
          packet_{av_packet_alloc()} {
        index_ = av_find_best_stream(input_.get(), AVMEDIA_TYPE_VIDEO, -1, -1, nullptr, 0);
        if (index_ >= 0) decoder_ = openDecoder(stream());
        if (!decoder_)
            throw Error(name_ +
                        ": has no pictures that can be decoded; choose another format, as by "
                        "?input_format=mjpeg of a camera");
    }

    // The next frame; null at the end. A file is read at the speed at which it was filmed.
    Owner<AVFrame> next() {
        Owner<AVFrame> frame(av_frame_alloc());
        while (avcodec_receive_frame(decoder_.get(), frame.get()) != 0)
            if (!feed()) return nullptr;
        if (!isLive_) pace(*frame);
        return frame;
    }

    [[nodiscard]] Clock::duration period() const {
        const double rate = av_q2d(stream().avg_frame_rate);
        return std::chrono::duration_cast<Clock::duration>(
            std::chrono::duration<double>(rate > 0 ? 1 / rate : 0.1));
    }
    // When the frame was taken, where its time is of this machine's clock.
    [[nodiscard]] std::optional<Clock::time_point> takenAt(const AVFrame& frame) const {
        if (frame.pts == AV_NOPTS_VALUE) return std::nullopt;
        const Clock::time_point at{secondsOf(frame)};
        const auto age = Clock::now() - at;
        return age >= 0s && age < 10s ? std::optional(at) : std::nullopt;
    }

  private:
    [[nodiscard]] const AVStream& stream() const { return *input_->streams[index_]; }
    [[nodiscard]] Clock::duration secondsOf(const AVFrame& frame) const {
        const double seconds = static_cast<double>(frame.pts) * av_q2d(stream().time_base);
        return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    }
    // Another packet into the decoder; one that it cannot use is left out.
    bool feed() {
        do {
            av_packet_unref(packet_.get());
            if (av_read_frame(input_.get(), packet_.get()) < 0) return false;
        } while (packet_->stream_index != index_);
        avcodec_send_packet(decoder_.get(), packet_.get());
        return true;
    }
    void pace(const AVFrame& frame) {
        if (frame.pts == AV_NOPTS_VALUE) return;
        if (!begun_) begun_ = Clock::now() - secondsOf(frame);
        std::this_thread::sleep_until(*begun_ + secondsOf(frame));
    }

    std::string name_;
    bool isLive_;
    Owner<AVFormatContext> input_;
    Owner<AVPacket> packet_;
    Owner<AVCodecContext> decoder_;
    int index_ = -1;
    std::optional<Clock::time_point> begun_;
};

// A frame, the time when it was taken (if known), and the number of frames before it.
struct TakenFrame {
    Owner<AVFrame> frame;
    Clock::time_point at;
    std::uint64_t number = 0;
};

// Reads all frames as they arrive, so that none waits in a driver, and keeps the newest.
class StreamCamera final : public Camera {
  public:
    explicit StreamCamera(const std::string& device) : device_{device} {
        const Source source = sourceOf(device);
        reader_.emplace(source, isOver_);
        if (device.starts_with(kVideo)) controls_.emplace(source.name);
        thread_ = std::thread([this] { read(); });
    }
    ~StreamCamera() override {
        isOver_ = true;
        thread_.join();
    }
    StreamCamera(const StreamCamera&) = delete;
    StreamCamera& operator=(const StreamCamera&) = delete;

    [[nodiscard]] ExposureRange exposures() const override {
        return controls_ ? controls_->exposures() : ExposureRange{};
    }

    [[nodiscard]] Picture take(double exposureSeconds) override {
        if (controls_ && exposure_ != exposureSeconds) controls_->expose(exposureSeconds);
        const bool isNew = std::exchange(exposure_, exposureSeconds) != exposureSeconds;
        const std::chrono::duration<double> exposed(controls_ ? exposureSeconds : 0);
        return pictureOf(*awaitFrame(exposed, isNew ? kSettling : kHeld).frame, device_);
    }

  private:
    // Frames that may still be in the driver, and the time until a new exposure takes effect.
    static constexpr std::uint64_t kHeld = 2;
    static constexpr std::uint64_t kSettling = 5;

    void read() {
        std::uint64_t number = 0;
        while (!isOver_) {
            Owner<AVFrame> frame = reader_->next();
            const std::lock_guard lock(mutex_);
            if (!frame) {
                hasEnded_ = true;
                return came_.notify_all();
            }
            const auto at = reader_->takenAt(*frame).value_or(Clock::now());
            newest_ = {std::move(frame), at, ++number};
            came_.notify_all();
        }
    }

    // The first frame, after `held` more, whose exposure began after now.
    TakenFrame awaitFrame(std::chrono::duration<double> exposure, std::uint64_t held) {
        std::unique_lock lock(mutex_);
        const auto from = Clock::now() + reader_->period() +
                          std::chrono::duration_cast<Clock::duration>(exposure);
        const std::uint64_t after = newest_.number + held;
        const auto isIt = [&] { return newest_.number > after && newest_.at >= from; };
        came_.wait_until(lock, from + kPatience, [&] { return hasEnded_ || isIt(); });
        if (hasEnded_)
            throw Error(device_ +
                        ": has ended, or the camera was unplugged; plug it in again or film for "
                        "longer, and scan again");
        if (!isIt())
            throw Error(device_ +
                        ": gives no new picture for ten seconds; plug it in again, by a shorter "
                        "cable or at another port, or ask it for smaller pictures "
                        "(?video_size=1280x720)");
        return std::exchange(newest_, {nullptr, newest_.at, newest_.number});
    }

    static constexpr auto kPatience = 10s;
    std::string device_;
    std::atomic<bool> isOver_ = false;
    std::optional<FrameReader> reader_;
    std::optional<CameraControls> controls_;
    double exposure_ = 0;
    std::mutex mutex_;  // guards the members below
    std::condition_variable came_;
    TakenFrame newest_;
    bool hasEnded_ = false;
    std::thread thread_;
};

}  // namespace

std::unique_ptr<Camera> openCamera(const std::string& device) {
    if (device.starts_with(kGphoto)) return openGphoto(device.substr(kGphoto.size()));
    av_log_set_level(AV_LOG_FATAL);
    avdevice_register_all();
    return std::make_unique<StreamCamera>(device);
}

}  // namespace aquarama::scan
