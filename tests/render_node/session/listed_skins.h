// SPDX-License-Identifier: Apache-2.0
// Drawings as a master has them: pictures of one colour, and the list of them.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "common/net/blob.h"
#include "common/net/channels.h"
#include "common/wire/messages.h"
#include "tests/support/plain_skin.h"

namespace aquarama::test {

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
