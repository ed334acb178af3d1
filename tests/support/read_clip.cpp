// SPDX-License-Identifier: Apache-2.0
#include "tests/support/read_clip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include <glm/common.hpp>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libswscale/swscale.h>
}

#include "common/base/log.h"

namespace aquarama::test {

namespace {

// The library's fast way is two codes off.
constexpr int kConversion =
    SWS_BILINEAR | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INP | SWS_FULL_CHR_H_INT;

struct Free {
    void operator()(AVFormatContext* file) const { avformat_close_input(&file); }
    void operator()(AVCodecContext* decoder) const { avcodec_free_context(&decoder); }
    void operator()(AVFrame* frame) const { av_frame_free(&frame); }
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
    void operator()(SwsContext* converter) const { sws_freeContext(converter); }
};

Picture pictureOf(const AVFrame& frame) {
    const std::unique_ptr<SwsContext, Free> converter{
        sws_getContext(frame.width,
                       frame.height,
                       static_cast<AVPixelFormat>(frame.format),
                       frame.width,
                       frame.height,
                       AV_PIX_FMT_RGB24,
                       kConversion,
                       nullptr,
                       nullptr,
                       nullptr)};
    const int* rec709 = sws_getCoefficients(SWS_CS_ITU709);
    sws_setColorspaceDetails(converter.get(), rec709, 0, rec709, 1, 0, 1 << 16, 1 << 16);
    std::vector<std::uint8_t> rgb(3 * static_cast<std::size_t>(frame.width) *
                                  static_cast<std::size_t>(frame.height));
    const std::array<std::uint8_t*, 1> planes{rgb.data()};
    const std::array<int, 1> strides{3 * frame.width};
    sws_scale(converter.get(),
              frame.data,
              frame.linesize,
              0,
              frame.height,
              planes.data(),
              strides.data());
    return {{frame.width, frame.height}, 8, {rgb.begin(), rgb.end()}};
}

}  // namespace

SeenClip readClip(const std::string& path) {
    AVFormatContext* opened = nullptr;
    if (avformat_open_input(&opened, path.c_str(), nullptr, nullptr) < 0)
        throw Error(path + ": is no clip");
    const std::unique_ptr<AVFormatContext, Free> file{opened};
    if (avformat_find_stream_info(opened, nullptr) < 0 || opened->nb_streams != 1)
        throw Error(path + ": has not one stream");
    const AVStream& stream = *opened->streams[0];
    const AVCodec* codec = avcodec_find_decoder(stream.codecpar->codec_id);
    const std::unique_ptr<AVCodecContext, Free> decoder{avcodec_alloc_context3(codec)};
    avcodec_parameters_to_context(decoder.get(), stream.codecpar);
    avcodec_open2(decoder.get(), codec, nullptr);

    SeenClip clip;
    clip.codec = avcodec_get_name(stream.codecpar->codec_id);
    clip.sizePixels = {stream.codecpar->width, stream.codecpar->height};
    clip.durationSeconds = static_cast<double>(opened->duration) / AV_TIME_BASE;
    const std::unique_ptr<AVPacket, Free> packet{av_packet_alloc()};
    const std::unique_ptr<AVFrame, Free> frame{av_frame_alloc()};
    const auto take = [&] {
        while (avcodec_receive_frame(decoder.get(), frame.get()) >= 0) {
            clip.pictures.push_back(pictureOf(*frame));
            clip.seconds.push_back(static_cast<double>(frame->pts) * av_q2d(stream.time_base));
        }
    };
    while (av_read_frame(opened, packet.get()) >= 0) {
        avcodec_send_packet(decoder.get(), packet.get());
        av_packet_unref(packet.get());
        take();
    }
    avcodec_send_packet(decoder.get(), nullptr);
    take();
    return clip;
}

double meanCodesBetween(const Picture& one, const Picture& other) {
    const glm::ivec2 size = glm::min(one.sizePixels, other.sizePixels);
    double sum = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < 3 * size.x; ++x) {
            const auto at = [&](const Picture& picture) {
                return picture.rgb[static_cast<std::size_t>(3 * y * picture.sizePixels.x + x)];
            };
            sum += std::abs(at(one) - at(other));
        }
    return sum / (3.0 * size.x * size.y);
}

}  // namespace aquarama::test
