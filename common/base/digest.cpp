// SPDX-License-Identifier: Apache-2.0
#include "common/base/digest.h"

#include <openssl/sha.h>

namespace aquarama {

Digest digestOf(std::span<const std::byte> content) {
    Digest digest;
    SHA256(reinterpret_cast<const unsigned char*>(content.data()),
           content.size(),
           digest.bytes.data());
    return digest;
}

Digest digestOf(std::string_view content) {
    return digestOf(std::as_bytes(std::span{content.data(), content.size()}));
}

std::string toHex(const Digest& digest) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string hex;
    for (const std::uint8_t byte : digest.bytes) {
        hex += kDigits[byte >> 4U];
        hex += kDigits[byte & 0xFU];
    }
    return hex;
}

std::uint64_t shortHash(const Digest& digest) {
    std::uint64_t hash = 0;
    for (std::size_t i = 0; i < sizeof hash; ++i) hash = hash << 8U | digest.bytes[i];
    return hash;
}

}  // namespace aquarama
