// SPDX-License-Identifier: Apache-2.0
#include "common/enrol/words.h"

#include <algorithm>

namespace aquarama::enrol {

std::vector<std::byte> packetOf(const Word& word) {
    std::vector<std::byte> packet{static_cast<std::byte>(word.kind)};
    std::ranges::transform(word.content, std::back_inserter(packet), [](char letter) {
        return static_cast<std::byte>(letter);
    });
    return packet;
}

std::optional<Word> wordIn(std::span<const std::byte> packet) {
    if (packet.empty() || packet.size() > kMostWordBytes) return std::nullopt;
    const auto kind = static_cast<Word::Kind>(packet.front());
    if (kind < Word::Kind::Proof || kind > Word::Kind::Refused) return std::nullopt;
    std::string content;
    for (const std::byte byte : packet.subspan(1)) content += static_cast<char>(byte);
    return Word{kind, content};
}

}  // namespace aquarama::enrol
