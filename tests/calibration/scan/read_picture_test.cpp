// SPDX-License-Identifier: Apache-2.0
#include "calibration/scan/read_picture.h"

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/frame.h>
}

#include "common/base/log.h"

namespace aquarama::scan {
namespace {

using ::testing::HasSubstr;

constexpr glm::ivec2 kSize{48, 32};

std::string inFolder(const std::string& name) {
    return (std::filesystem::path(::testing::TempDir()) / name).string();
}

void writeFile(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

// Even steps along both axes.
int levelAt(int x, int y) {
    return 4 * x + y;
}

// One picture by an encoder of FFmpeg: each plane has the same levels, of `scale` codes a step.
std::string encoded(AVCodecID id, AVPixelFormat format, int scale = 1) {
    const AVCodec* codec = avcodec_find_encoder(id);
    const auto freeContext = [](AVCodecContext* context) { avcodec_free_context(&context); };
    const std::unique_ptr<AVCodecContext, decltype(freeContext)> encoder(
        avcodec_alloc_context3(codec), freeContext);
    encoder->width = kSize.x;
    encoder->height = kSize.y;
    encoder->pix_fmt = format;
    encoder->time_base = {1, 25};
    encoder->flags |= AV_CODEC_FLAG_QSCALE;
    encoder->global_quality = FF_QP2LAMBDA;  // the best
    EXPECT_EQ(avcodec_open2(encoder.get(), codec, nullptr), 0);
    AVFrame* frame = av_frame_alloc();
    frame->format = format;
    frame->width = kSize.x;
    frame->height = kSize.y;
    frame->quality = FF_QP2LAMBDA;
    EXPECT_EQ(av_frame_get_buffer(frame, 0), 0);
    const bool isYuv = format == AV_PIX_FMT_YUVJ444P;
    for (int y = 0; y < kSize.y; ++y)
        for (int x = 0; x < kSize.x; ++x) {
            const int level = levelAt(x, y) * scale;
            if (isYuv) {
                frame->data[0][y * frame->linesize[0] + x] = static_cast<std::uint8_t>(level);
                for (const int plane : {1, 2})
                    frame->data[plane][y * frame->linesize[plane] + x] = 128;
                continue;
            }
            auto* row = frame->data[0] + y * frame->linesize[0];
            for (int c = 0; c < 3; ++c) {
                if (format == AV_PIX_FMT_RGB24)
                    row[3 * x + c] = static_cast<std::uint8_t>(level);
                else
                    reinterpret_cast<std::uint16_t*>(row)[3 * x + c] =
                        static_cast<std::uint16_t>(level + c);
            }
        }
    AVPacket* packet = av_packet_alloc();
    EXPECT_EQ(avcodec_send_frame(encoder.get(), frame), 0);
    EXPECT_EQ(avcodec_send_frame(encoder.get(), nullptr), 0);
    EXPECT_EQ(avcodec_receive_packet(encoder.get(), packet), 0);
    std::string bytes(reinterpret_cast<const char*>(packet->data),
                      static_cast<std::size_t>(packet->size));
    av_packet_free(&packet);
    av_frame_free(&frame);
    return bytes;
}

std::string readingError(const std::string& path) {
    try {
        (void)readPicture(path);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

// The largest difference of the picture from `scale` times the levels (and `perColour` a colour).
int largestError(const Picture& picture, int scale, int perColour) {
    int largest = 0;
    for (int y = 0; y < kSize.y; ++y)
        for (int x = 0; x < kSize.x; ++x)
            for (int c = 0; c < 3; ++c) {
                const auto i = static_cast<std::size_t>(3 * (y * kSize.x + x) + c);
                const int wanted = levelAt(x, y) * scale + perColour * c;
                largest = std::max(largest, std::abs(picture.rgb[i] - wanted));
            }
    return largest;
}

TEST(ReadPicture, aJpegHasItsCodesOfEightBits) {
    const std::string path = inFolder("levels.jpg");
    writeFile(path, encoded(AV_CODEC_ID_MJPEG, AV_PIX_FMT_YUVJ444P));
    const Picture picture = readPicture(path);
    EXPECT_EQ(picture.sizePixels, kSize);
    EXPECT_EQ(picture.bits, 8);
    EXPECT_LE(largestError(picture, 1, 0), 4);  // the encoder's own loss
}

TEST(ReadPicture, aTiffIsReadExactlyInEightAndSixteenBits) {
    const std::string path = inFolder("levels.tif");
    writeFile(path, encoded(AV_CODEC_ID_TIFF, AV_PIX_FMT_RGB24));
    EXPECT_EQ(readPicture(path).bits, 8);
    EXPECT_EQ(largestError(readPicture(path), 1, 0), 0);
    writeFile(path, encoded(AV_CODEC_ID_TIFF, AV_PIX_FMT_RGB48LE, 241));
    EXPECT_EQ(readPicture(path).bits, 16);
    EXPECT_EQ(largestError(readPicture(path), 241, 1), 0);
}

TEST(ReadPicture, aPngIsReadAsItIsWhateverItsName) {
    const std::string path = inFolder("picture.dat");
    const Picture written{{2, 1}, 16, {1, 2, 3, 65535, 256, 0}};
    writePng(path, written);
    EXPECT_EQ(readPicture(path).rgb, written.rgb);
    EXPECT_EQ(readPicture(path).bits, 16);
}

TEST(ReadPicture, tornAndForeignFilesAreNamed) {
    const std::string whole = encoded(AV_CODEC_ID_MJPEG, AV_PIX_FMT_YUVJ444P);
    const std::string path = inFolder("torn.jpg");
    writeFile(path, whole.substr(0, whole.size() / 2));
    EXPECT_THAT(readingError(path), HasSubstr("torn.jpg: is no whole JPEG"));
    writeFile(path, "II");
    EXPECT_THAT(readingError(path), HasSubstr("no PNG, JPEG or TIFF"));
    writeFile(path, std::string("II*\0", 4) + "rest");
    EXPECT_THAT(readingError(path), HasSubstr("no whole TIFF"));
    EXPECT_THAT(readingError(inFolder("none.jpg")), HasSubstr("none.jpg"));
}

// The size stands in the file's head, before any memory is taken for it.
TEST(ReadPicture, aJpegThatSaysItIsHugeIsRefused) {
    std::string bytes = encoded(AV_CODEC_ID_MJPEG, AV_PIX_FMT_YUVJ444P);
    const std::size_t frame = bytes.find("\xff\xc0");
    ASSERT_NE(frame, std::string::npos);
    for (std::size_t i = frame + 5; i < frame + 9; ++i) bytes[i] = '\x7f';
    const std::string path = inFolder("huge.jpg");
    writeFile(path, bytes);
    EXPECT_THAT(readingError(path), HasSubstr("huge.jpg: is no whole JPEG"));
}

}  // namespace
}  // namespace aquarama::scan
