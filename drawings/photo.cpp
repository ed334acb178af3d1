// SPDX-License-Identifier: Apache-2.0
#include "drawings/photo.h"

#include <algorithm>
#include <array>
#include <memory>
#include <string_view>

#include <glm/common.hpp>
#include <turbojpeg.h>
#include <webp/decode.h>

#include "common/base/picture.h"
#include "drawings/refusal.h"

namespace aquarama::drawings {

namespace {

using Bytes = std::span<const std::byte>;

const std::uint8_t* dataOf(Bytes bytes) {
    return reinterpret_cast<const std::uint8_t*>(bytes.data());
}

bool beginsWith(Bytes bytes, std::size_t at, std::string_view magic) {
    return bytes.size() >= at + magic.size() &&
           std::string_view(reinterpret_cast<const char*>(bytes.data()) + at, magic.size()) ==
               magic;
}

[[noreturn]] void refuse() {
    throw Refusal(RefusalReason::NotAPicture);
}

// Memory for a picture of this size. Throws Refusal.
Photo photoOf(std::int64_t width, std::int64_t height) {
    if (width < 1 || height < 1) refuse();
    if (width > kMostPixelsEachWay || height > kMostPixelsEachWay ||
        width * height > kMostPhotoPixels)
        throw Refusal(RefusalReason::TooLarge);
    Photo photo{{width, height}, {}};
    photo.rgb.resize(3 * static_cast<std::size_t>(width * height));
    return photo;
}

Photo decodeJpeg(Bytes bytes) {
    const std::unique_ptr<void, int (*)(tjhandle)> decoder(tjInitDecompress(), tjDestroy);
    int width = 0, height = 0, subsampling = 0, colours = 0;
    if (!decoder ||
        tjDecompressHeader3(
            decoder.get(), dataOf(bytes), bytes.size(), &width, &height, &subsampling, &colours) !=
            0)
        refuse();
    Photo photo = photoOf(width, height);
    if (tjDecompress2(decoder.get(),
                      dataOf(bytes),
                      bytes.size(),
                      photo.rgb.data(),
                      width,
                      0,
                      height,
                      TJPF_RGB,
                      TJFLAG_LIMITSCANS) != 0)
        refuse();
    return photo;
}

Photo decodeWebp(Bytes bytes) {
    WebPBitstreamFeatures features{};
    if (WebPGetFeatures(dataOf(bytes), bytes.size(), &features) != VP8_STATUS_OK ||
        features.has_animation != 0)
        refuse();
    Photo photo = photoOf(features.width, features.height);
    if (WebPDecodeRGBInto(
            dataOf(bytes), bytes.size(), photo.rgb.data(), photo.rgb.size(), 3 * features.width) ==
        nullptr)
        refuse();
    return photo;
}

// A big-endian number of a PNG's header.
std::int64_t numberAt(Bytes bytes, std::size_t at) {
    std::int64_t number = 0;
    for (std::size_t i = 0; i < 4; ++i)
        number = number << 8 | std::to_integer<std::int64_t>(bytes[at + i]);
    return number;
}

Photo decodePngPhoto(Bytes bytes) {
    constexpr std::size_t kWidthAt = 16, kHeightAt = 20, kHeader = 24;
    if (bytes.size() < kHeader) refuse();
    Photo photo = photoOf(numberAt(bytes, kWidthAt), numberAt(bytes, kHeightAt));
    try {
        const PngPicture png = decodePng(bytes, "picture");
        const int shift = png.bits == 16 ? 8 : 0;
        const auto components = static_cast<std::size_t>(png.components);
        if (png.sizePixels != photo.sizePixels) refuse();
        for (std::size_t i = 0; i < photo.rgb.size(); ++i)
            photo.rgb[i] = static_cast<std::uint8_t>(
                png.codes[components == 3 ? i : i / 3 * components] >> shift);
    } catch (const Error&) {
        refuse();
    }
    return photo;
}

}  // namespace

Photo decodePhoto(Bytes bytes) {
    if (bytes.size() > kMostPhotoBytes) throw Refusal(RefusalReason::TooLarge);
    if (beginsWith(bytes, 0, "\xFF\xD8\xFF")) return decodeJpeg(bytes);
    if (beginsWith(bytes, 0, "\x89PNG\r\n\x1A\n")) return decodePngPhoto(bytes);
    if (beginsWith(bytes, 0, "RIFF") && beginsWith(bytes, 8, "WEBP")) return decodeWebp(bytes);
    refuse();
}

PhotoLight::PhotoLight(const Photo& photo) : photo_{photo} {
    constexpr int kCodes = 256;
    for (int code = 0; code < kCodes; ++code)
        light_.push_back(static_cast<float>(linearFromSrgb(code / 255.0)));
}

glm::vec3 PhotoLight::pixel(int x, int y) const {
    const std::size_t at =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(photo_.sizePixels.x) +
             static_cast<std::size_t>(x));
    return {light_[photo_.rgb[at]], light_[photo_.rgb[at + 1]], light_[photo_.rgb[at + 2]]};
}

glm::vec3 PhotoLight::at(glm::dvec2 pixel) const {
    const glm::dvec2 last(photo_.sizePixels - 1);
    const glm::dvec2 at = glm::clamp(pixel - 0.5, glm::dvec2(0), last);
    const glm::ivec2 low(at);
    const glm::ivec2 high = glm::min(low + 1, photo_.sizePixels - 1);
    const glm::vec2 t(at - glm::dvec2(low));
    return glm::mix(glm::mix(this->pixel(low.x, low.y), this->pixel(high.x, low.y), t.x),
                    glm::mix(this->pixel(low.x, high.y), this->pixel(high.x, high.y), t.x),
                    t.y);
}

}  // namespace aquarama::drawings
