// SPDX-License-Identifier: Apache-2.0
// Packets of Open Sound Control (OSC 1.0), as values. Every byte is checked before liblo reads it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace aquarama::osc {

// Bounds of a packet that is read. Bundles may lie in bundles.
inline constexpr std::size_t kMostPacketBytes = 8192;
inline constexpr std::size_t kMostMessages = 128;
inline constexpr std::size_t kMostArguments = 128;  // of one message
inline constexpr int kMostDepth = 4;                // of bundles

// A whole number (type tags i and h; t, a time of NTP; T and F, which are 1 and 0), a number (f and
// d) or a text (s and S).
using OscArgument = std::variant<std::int64_t, double, std::string>;

// What is said to an address, as "/aquarama/black".
struct OscMessage {
    std::string address;  // printable ASCII, beginning with "/"
    std::vector<OscArgument> arguments;
    friend bool operator==(const OscMessage&, const OscMessage&) = default;
};

// What a packet holds: its messages in their order, those of bundles too, or why it is refused.
struct OscPacket {
    std::vector<OscMessage> messages;
    std::string problem;  // one line; empty: none
};

// Reads a packet whole, or refuses it. Numbers may be infinite or none (NaN); times of bundles are
// passed over.
[[nodiscard]] OscPacket decode(std::span<const std::byte> bytes);

// A message as a packet: whole numbers as i, or h where they are larger, numbers as f, texts as s.
[[nodiscard]] std::vector<std::byte> encode(const OscMessage& message);

}  // namespace aquarama::osc
