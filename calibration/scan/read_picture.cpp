// SPDX-License-Identifier: Apache-2.0
#include "calibration/scan/read_picture.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavutil/imgutils.h>
#include <libavutil/pixdesc.h>
#include <libswscale/swscale.h>
}

#include "common/base/files.h"
#include "common/base/log.h"

namespace aquarama::scan {

namespace {

// As common/base/picture.h reads PNG.
constexpr int kLargest = 16384;
constexpr std::int64_t kMostPixels = std::int64_t{1} << 26;
constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 29;

struct Free {
    void operator()(AVCodecContext* decoder) const { avcodec_free_context(&decoder); }
    void operator()(AVFrame* frame) const { av_frame_free(&frame); }
    void operator()(AVPacket* packet) const { av_packet_free(&packet); }
    void operator()(SwsContext* converter) const { sws_freeContext(converter); }
};
template <class Owned>
using Owner = std::unique_ptr<Owned, Free>;

// Of the first bytes of a file.
AVCodecID codecOf(std::span<const std::byte> file) {
    using namespace std::string_view_literals;
    const std::string_view start(reinterpret_cast<const char*>(file.data()),
                                 std::min<std::size_t>(file.size(), 4));
    if (start.starts_with("\xff\xd8\xff"sv)) return AV_CODEC_ID_MJPEG;
    if (start == "II*\0"sv || start == "MM\0*"sv) return AV_CODEC_ID_TIFF;
    return AV_CODEC_ID_NONE;
}

bool isPng(std::span<const std::byte> file) {
    constexpr std::string_view kSignature = "\x89PNG";
    return file.size() >= kSignature.size() &&
           std::memcmp(file.data(), kSignature.data(), kSignature.size()) == 0;
}

// FFmpeg's readers may look past the end of a packet: it has their margin of zeros.
Owner<AVPacket> packetOf(std::span<const std::byte> file) {
    Owner<AVPacket> packet(av_packet_alloc());
    if (!packet || av_new_packet(packet.get(), static_cast<int>(file.size())) != 0) return nullptr;
    std::memcpy(packet->data, file.data(), file.size());
    return packet;
}

Owner<AVCodecContext> decoderOf(AVCodecID id) {
    const AVCodec* codec = avcodec_find_decoder(id);
    Owner<AVCodecContext> decoder(codec == nullptr ? nullptr : avcodec_alloc_context3(codec));
    if (!decoder) return nullptr;
    decoder->max_pixels = kMostPixels;
    // A truncated file is an error, not a picture that ends in grey. The reader of TIFF always
    // checks its strips; with this flag it would also refuse unknown tags.
    if (id == AV_CODEC_ID_MJPEG) decoder->err_recognition |= AV_EF_EXPLODE;
    decoder->thread_count = 1;
    return avcodec_open2(decoder.get(), codec, nullptr) == 0 ? std::move(decoder) : nullptr;
}

// Null where it cannot be decoded.
Owner<AVFrame> decodeFile(AVCodecID id, std::span<const std::byte> file) {
    av_log_set_level(AV_LOG_FATAL);
    const Owner<AVPacket> packet = packetOf(file);
    const Owner<AVCodecContext> decoder = decoderOf(id);
    Owner<AVFrame> frame(av_frame_alloc());
    if (!packet || !decoder || !frame) return nullptr;
    if (avcodec_send_packet(decoder.get(), packet.get()) != 0) return nullptr;
    avcodec_send_packet(decoder.get(), nullptr);
    const bool whole =
        avcodec_receive_frame(decoder.get(), frame.get()) == 0 && frame->decode_error_flags == 0;
    return whole ? std::move(frame) : nullptr;
}

// What a frame is converted to: as many bits and colours as it has.
struct Codes {
    AVPixelFormat format = AV_PIX_FMT_RGB24;
    int components = 3;
    int bits = 8;
};
Codes codesOf(const AVPixFmtDescriptor& from) {
    int bits = 8;
    for (int i = 0; i < from.nb_components; ++i) bits = std::max(bits, from.comp[i].depth);
    const bool isDeep = bits > 8;
    const bool isGrey = from.nb_components <= 2 && (from.flags & AV_PIX_FMT_FLAG_PAL) == 0;
    if (isGrey) return {isDeep ? AV_PIX_FMT_GRAY16 : AV_PIX_FMT_GRAY8, 1, isDeep ? 16 : 8};
    return {isDeep ? AV_PIX_FMT_RGB48 : AV_PIX_FMT_RGB24, 3, isDeep ? 16 : 8};
}

Owner<SwsContext> converterOf(const AVFrame& frame, AVPixelFormat to) {
    constexpr int kExact =
        SWS_BILINEAR | SWS_ACCURATE_RND | SWS_FULL_CHR_H_INP | SWS_FULL_CHR_H_INT;
    const auto from = static_cast<AVPixelFormat>(frame.format);
    Owner<SwsContext> converter(sws_getContext(frame.width,
                                               frame.height,
                                               from,
                                               frame.width,
                                               frame.height,
                                               to,
                                               kExact,
                                               nullptr,
                                               nullptr,
                                               nullptr));
    const bool isRec709 = frame.colorspace == AVCOL_SPC_BT709;
    const int* matrix = sws_getCoefficients(isRec709 ? SWS_CS_ITU709 : SWS_CS_ITU601);
    int* ignored = nullptr;
    int fullIn = 0, fullOut = 0, brightness = 0, contrast = 0, saturation = 0;
    if (!converter || sws_getColorspaceDetails(converter.get(),
                                               &ignored,
                                               &fullIn,
                                               &ignored,
                                               &fullOut,
                                               &brightness,
                                               &contrast,
                                               &saturation) < 0)
        return converter;
    if (frame.color_range == AVCOL_RANGE_JPEG) fullIn = 1;
    sws_setColorspaceDetails(
        converter.get(), matrix, fullIn, matrix, fullOut, brightness, contrast, saturation);
    return converter;
}

// Packed rows of `codes`.
std::vector<std::uint8_t> convert(const AVFrame& frame, const Codes& codes) {
    const Owner<SwsContext> converter = converterOf(frame, codes.format);
    const int rowBytes = frame.width * codes.components * codes.bits / 8;
    // Its fast paths may write some bytes past the last row.
    constexpr std::size_t kMargin = 64;
    std::vector<std::uint8_t> bytes(
        static_cast<std::size_t>(rowBytes) * static_cast<std::size_t>(frame.height) + kMargin);
    const std::array<std::uint8_t*, 4> planes{bytes.data()};
    const std::array<int, 4> strides{rowBytes};
    if (!converter || sws_scale(converter.get(),
                                frame.data,
                                frame.linesize,
                                0,
                                frame.height,
                                planes.data(),
                                strides.data()) != frame.height)
        return {};
    bytes.resize(bytes.size() - kMargin);
    return bytes;
}

// Red green blue, of the machine's byte order where they have two bytes.
std::vector<std::uint16_t> unpacked(const std::vector<std::uint8_t>& bytes, const Codes& codes) {
    const std::size_t size = codes.bits == 16 ? 2 : 1;
    const std::size_t copies = codes.components == 1 ? 3 : 1;
    std::vector<std::uint16_t> rgb(bytes.size() / size * copies);
    for (std::size_t i = 0; i < rgb.size(); ++i) {
        const std::uint8_t* at = bytes.data() + i / copies * size;
        std::uint16_t code = *at;
        if (size == 2) std::memcpy(&code, at, size);
        rgb[i] = code;
    }
    return rgb;
}

bool isWithinBounds(const AVFrame& frame) {
    return frame.width > 0 && frame.height > 0 && frame.width <= kLargest &&
           frame.height <= kLargest &&
           std::int64_t{frame.width} * std::int64_t{frame.height} <= kMostPixels;
}

}  // namespace

Picture pictureOf(const AVFrame& frame, const std::string& source) {
    if (!isWithinBounds(frame))
        throw Error(source + ": a picture of " + std::to_string(frame.width) + " x " +
                    std::to_string(frame.height) +
                    " pixels; take one of at most 16384 each way and 64 million in all");
    const AVPixFmtDescriptor* from = av_pix_fmt_desc_get(static_cast<AVPixelFormat>(frame.format));
    const Codes codes = from == nullptr ? Codes{} : codesOf(*from);
    const std::vector<std::uint8_t> bytes =
        from == nullptr ? std::vector<std::uint8_t>{} : convert(frame, codes);
    if (bytes.empty())
        throw Error(source + ": pixels of the format " + (from == nullptr ? "?" : from->name) +
                    " cannot be converted; let the camera give RGB, YUV or MJPEG");
    return {{frame.width, frame.height}, codes.bits, unpacked(bytes, codes)};
}

Picture readPicture(const std::string& path) {
    const std::vector<std::byte> file = readWhole(path, kMostBytes);
    if (isPng(file)) return readPng(path);
    const AVCodecID codec = codecOf(file);
    if (codec == AV_CODEC_ID_NONE)
        throw Error(path + ": is no PNG, JPEG or TIFF picture; convert it to one of these");
    const Owner<AVFrame> frame = decodeFile(codec, file);
    if (!frame)
        throw Error(path + ": is no whole " + (codec == AV_CODEC_ID_TIFF ? "TIFF" : "JPEG") +
                    " picture of at most 64 million pixels; copy it from the camera anew");
    return pictureOf(*frame, path);
}

}  // namespace aquarama::scan
