// SPDX-License-Identifier: Apache-2.0
// A small picture in each of the formats that visitors send.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <turbojpeg.h>
#include <webp/encode.h>

#include "common/base/picture.h"
#include "drawings/photo.h"

namespace aquarama::test {

// Colours that change from left to right and from top to bottom.
inline drawings::Photo gradient() {
    drawings::Photo photo{{64, 48}, {}};
    for (int y = 0; y < photo.sizePixels.y; ++y)
        for (int x = 0; x < photo.sizePixels.x; ++x)
            for (const int code : {4 * x, 5 * y, 128})
                photo.rgb.push_back(static_cast<std::uint8_t>(code));
    return photo;
}

// Copies what a library has allocated, and frees it. Empty where the library has failed.
template <class Free>
std::vector<std::byte> takenFrom(std::uint8_t* bytes, std::size_t count, Free free) {
    const std::unique_ptr<std::uint8_t, Free> owner(bytes, free);
    const auto file = std::as_bytes(std::span(bytes, count));
    return {file.begin(), file.end()};
}

inline std::vector<std::byte> jpegOf(const drawings::Photo& photo, int quality) {
    const std::unique_ptr<void, int (*)(tjhandle)> encoder(tjInitCompress(), tjDestroy);
    unsigned char* bytes = nullptr;
    unsigned long count = 0;
    const glm::ivec2 size = photo.sizePixels;
    tjCompress2(encoder.get(),
                photo.rgb.data(),
                size.x,
                0,
                size.y,
                TJPF_RGB,
                &bytes,
                &count,
                TJSAMP_420,
                quality,
                0);
    return takenFrom(bytes, count, tjFree);
}

inline std::vector<std::byte> webpOf(const drawings::Photo& photo) {
    std::uint8_t* bytes = nullptr;
    const glm::ivec2 size = photo.sizePixels;
    const std::size_t count =
        WebPEncodeLosslessRGB(photo.rgb.data(), size.x, size.y, 3 * size.x, &bytes);
    return takenFrom(bytes, count, WebPFree);
}

inline std::vector<std::byte> pngOf(const drawings::Photo& photo) {
    return encodePng(
        {.sizePixels = photo.sizePixels, .codes = {photo.rgb.begin(), photo.rgb.end()}},
        PngMeaning::Srgb);
}

}  // namespace aquarama::test
