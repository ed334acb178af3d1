// SPDX-License-Identifier: Apache-2.0
#include "common/wire/parts.h"

#include <algorithm>
#include <cassert>
#include <span>
#include <utility>

namespace aquarama::wire {

std::vector<Packet> partsOf(Packet packet, std::uint64_t number) {
    std::vector<Packet> parts;
    if (packet.size() <= kMostSmallPacketBytes) {
        parts.push_back(std::move(packet));
        return parts;
    }
    const auto count = static_cast<std::uint32_t>((packet.size() + kPartBytes - 1) / kPartBytes);
    assert(count <= kMostParts);
    for (std::uint32_t index = 0; index < count; ++index) {
        const std::size_t begin = index * kPartBytes;
        const auto content =
            std::span(packet).subspan(begin, std::min(kPartBytes, packet.size() - begin));
        v1::Envelope envelope;
        v1::PacketPart& part = *envelope.mutable_packet_part();
        part.set_packet(number);
        part.set_index(index);
        part.set_count(count);
        part.set_content(content.data(), content.size());
        parts.push_back(encode(0, std::move(envelope)));
    }
    return parts;
}

std::optional<Packet> PartAssembly::take(const std::string& sender,
                                         const v1::PacketPart& part,
                                         Moment now) {
    std::erase_if(begun_, [&](const auto& one) { return now - one.second.heard > kPatience; });
    if (part.index() == 0) {
        if (begun_.size() >= kMostSenders && !begun_.contains(sender)) return std::nullopt;
        begun_[sender] = {.packet = part.packet(), .next = 0, .bytes = {}, .heard = now};
    }
    const auto known = begun_.find(sender);
    if (known == begun_.end()) return std::nullopt;
    Begun& begun = known->second;
    if (begun.packet != part.packet() || begun.next != part.index()) return std::nullopt;
    const auto* const first = reinterpret_cast<const std::byte*>(part.content().data());
    begun.bytes.insert(begun.bytes.end(), first, first + part.content().size());
    begun.heard = now;
    if (++begun.next < part.count()) return std::nullopt;
    Packet whole = std::move(begun.bytes);
    begun_.erase(known);
    return whole;
}

}  // namespace aquarama::wire
