// SPDX-License-Identifier: Apache-2.0
// Packets that are too large for the master's control channel, in parts: a drawing is offered so.
// The bound of the channel stays small, whoever speaks.
#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/wire/messages.h"

namespace aquarama::wire {

inline constexpr std::size_t kPartBytes = 49'152;
inline constexpr std::uint32_t kMostParts = 64;

// The packets to send for a packet: itself where it is small enough, else its parts.
[[nodiscard]] std::vector<Packet> partsOf(Packet packet, std::uint64_t number);

// Puts packets together again, one at a time of each sender, which its connection names. Memory
// grows with what has arrived. One thread uses it.
class PartAssembly {
  public:
    using Moment = std::chrono::steady_clock::time_point;
    // Senders at once; a part of one more is dropped. What was not continued for so long is
    // forgotten.
    static constexpr std::size_t kMostSenders = 8;
    static constexpr std::chrono::seconds kPatience{5};

    // The packet, once its last part has come in order. Another part begins anew, or is dropped.
    [[nodiscard]] std::optional<Packet> take(const std::string& sender,
                                             const v1::PacketPart& part,
                                             Moment now);

  private:
    struct Begun {
        std::uint64_t packet = 0;
        std::uint32_t next = 0;  // index of the part that is to come
        Packet bytes;
        Moment heard{};
    };
    std::map<std::string, Begun> begun_;
};

}  // namespace aquarama::wire
