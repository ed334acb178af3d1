// SPDX-License-Identifier: Apache-2.0
// Drawings as a master has them: pictures of one colour, and the list of them.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "common/base/picture.h"
#include "common/body/side_view.h"
#include "common/net/blob.h"
#include "common/net/channels.h"
#include "common/wire/messages.h"

namespace aquarama::test {

// The PNG of a grey skin.
inline net::Blob plainSkin(std::uint16_t code) {
    const auto texels = static_cast<std::size_t>(body::kSideTexels.x * body::kSideTexels.y);
    const PngPicture picture{.sizePixels = body::kSideTexels,
                             .codes = std::vector<std::uint16_t>(3 * texels, code)};
    return std::make_shared<const net::ByteVector>(encodePng(picture, PngMeaning::Srgb));
}

// Adds pictures, all of clownfish, and their list to what a master has. Returns the list's digest.
inline Digest offerSkins(const std::vector<std::pair<std::uint32_t, net::Blob>>& pictures,
                         std::map<Digest, net::Blob>& masters) {
    v1::SkinList list;
    for (const auto& [number, blob] : pictures) {
        const Digest picture = digestOf(std::span{*blob});
        masters[picture] = blob;
        v1::ListedSkin& skin = *list.add_skins();
        skin.set_number(number);
        skin.set_picture(wire::bytesOf(picture));
        skin.set_species("clownfish");
    }
    const std::string text = list.SerializeAsString();
    const auto bytes = std::as_bytes(std::span{text});
    const auto blob = std::make_shared<const net::ByteVector>(bytes.begin(), bytes.end());
    const Digest digest = digestOf(std::span{*blob});
    masters[digest] = blob;
    return digest;
}

}  // namespace aquarama::test
