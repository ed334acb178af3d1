// SPDX-License-Identifier: Apache-2.0
// What a waiting node and who assigns it say to each other: packets of a byte that says what it is,
// and its content.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace aquarama::enrol {

// Proof goes both ways, a key file to the node, Taken and Refused from it.
struct Word {
    // The first byte of a packet.
    enum class Kind : unsigned char { Proof = 1, KeyFile = 2, Taken = 3, Refused = 4 };
    Kind kind = Kind::Refused;
    std::string content;  // 32 bytes; text of a key file; nothing; the reason
};
inline constexpr std::size_t kMostWordBytes = 4096;

// At most kMostWordBytes.
[[nodiscard]] std::vector<std::byte> packetOf(const Word& word);
// Empty where it is no packet of these, or larger than kMostWordBytes.
[[nodiscard]] std::optional<Word> wordIn(std::span<const std::byte> packet);

}  // namespace aquarama::enrol
