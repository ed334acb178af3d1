// SPDX-License-Identifier: Apache-2.0
// Addresses of machines as numbers. Names are not looked up: that may take a minute.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace aquarama::config {

// The number of one machine in its shortest form, so that equal ones are equal texts. Empty where
// it is none of version 4 or 6, or that of a network, of a group or of one cable alone.
[[nodiscard]] std::string shortestHost(const std::string& host);

// The same as addresses with a port have it: of version 6 in brackets.
[[nodiscard]] std::string bracketed(const std::string& host);

// One end of UDP.
struct UdpAddress {
    std::string host;  // as shortestHost() has it
    std::uint16_t port = 0;
    friend bool operator==(const UdpAddress&, const UdpAddress&) = default;
};

// Of "udp://192.168.7.1:7500" or "udp://[fd00::1]:7500"; nothing where the text is none.
[[nodiscard]] std::optional<UdpAddress> udpAddressIn(const std::string& text);
// The text of an address.
[[nodiscard]] std::string textOf(const UdpAddress& address);

}  // namespace aquarama::config
