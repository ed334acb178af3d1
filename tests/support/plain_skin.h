// SPDX-License-Identifier: Apache-2.0
// What a visitor may have painted, in one colour.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "common/base/picture.h"
#include "common/body/side_view.h"
#include "common/net/blob.h"

namespace aquarama::test {

// The PNG of a grey skin.
inline net::Blob plainSkin(std::uint16_t code) {
    const auto texels = static_cast<std::size_t>(body::kSideTexels.x * body::kSideTexels.y);
    const PngPicture picture{.sizePixels = body::kSideTexels,
                             .codes = std::vector<std::uint16_t>(3 * texels, code)};
    return std::make_shared<const std::vector<std::byte>>(encodePng(picture, PngMeaning::Srgb));
}

}  // namespace aquarama::test
