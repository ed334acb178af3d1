// SPDX-License-Identifier: Apache-2.0
#include "common/config/host.h"

#include <array>
#include <charconv>
#include <string_view>

#include <arpa/inet.h>
#include <netinet/in.h>

namespace aquarama::config {

namespace {

constexpr std::string_view kScheme = "udp://";

bool isOfAMachine(const in_addr& address) {
    const unsigned first = ntohl(address.s_addr) >> 24U;
    constexpr unsigned kFirstGroup = 224;
    return first > 0 && first < kFirstGroup;
}
bool isOfAMachine(const in6_addr& address) {
    return !IN6_IS_ADDR_UNSPECIFIED(&address) && !IN6_IS_ADDR_MULTICAST(&address) &&
           !IN6_IS_ADDR_LINKLOCAL(&address);
}

// 0 where it is none.
std::uint16_t portIn(std::string_view text) {
    std::uint16_t port = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, port);
    return error == std::errc{} && rest == end ? port : std::uint16_t{0};
}

}  // namespace

std::string shortestHost(const std::string& host) {
    std::array<char, INET6_ADDRSTRLEN> text{};
    in_addr four{};
    in6_addr six{};
    if (inet_pton(AF_INET, host.c_str(), &four) == 1 && isOfAMachine(four))
        return inet_ntop(AF_INET, &four, text.data(), text.size());
    if (inet_pton(AF_INET6, host.c_str(), &six) == 1 && isOfAMachine(six))
        return inet_ntop(AF_INET6, &six, text.data(), text.size());
    return {};
}

std::string bracketed(const std::string& host) {
    return host.find(':') == std::string::npos ? host : "[" + host + "]";
}

// Of version 6 in brackets: its colons are not the port's.
std::optional<UdpAddress> udpAddressIn(const std::string& text) {
    const std::size_t colon = text.rfind(':');
    if (!text.starts_with(kScheme) || colon < kScheme.size()) return std::nullopt;
    std::string host = text.substr(kScheme.size(), colon - kScheme.size());
    const bool hasBrackets = host.starts_with('[') && host.ends_with(']');
    if (hasBrackets != (host.find(':') != std::string::npos)) return std::nullopt;
    if (hasBrackets) host = host.substr(1, host.size() - 2);
    const UdpAddress address{shortestHost(host), portIn(std::string_view(text).substr(colon + 1))};
    return address.host.empty() || address.port == 0 ? std::nullopt : std::optional(address);
}

std::string textOf(const UdpAddress& address) {
    return std::string(kScheme) + bracketed(address.host) + ":" + std::to_string(address.port);
}

}  // namespace aquarama::config
