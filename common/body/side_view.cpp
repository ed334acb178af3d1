// SPDX-License-Identifier: Apache-2.0
#include "common/body/side_view.h"

#include <cstdint>
#include <cstring>
#include <string_view>

namespace aquarama::body {

// Signature, then the header's length, name, width, height and bits.
bool beginsAsSkin(std::span<const std::byte> png) {
    constexpr std::string_view kBegins{"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", 16};
    constexpr std::size_t kWidthAt = 16, kHeightAt = 20, kBitsAt = 24, kHeaderBytes = 29;
    const auto number = [&](std::size_t at) {
        std::uint32_t value = 0;
        for (std::size_t i = 0; i < 4; ++i)
            value = value << 8U | std::to_integer<std::uint32_t>(png[at + i]);
        return static_cast<std::int64_t>(value);
    };
    return png.size() >= kHeaderBytes &&
           std::memcmp(png.data(), kBegins.data(), kBegins.size()) == 0 &&
           number(kWidthAt) == kSideTexels.x && number(kHeightAt) == kSideTexels.y &&
           std::to_integer<int>(png[kBitsAt]) == 8;
}

}  // namespace aquarama::body
