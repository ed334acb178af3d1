// SPDX-License-Identifier: Apache-2.0
#include "common/net/address.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <string_view>

#include <arpa/inet.h>

#include "common/units/log.h"

namespace aquarama::net {
namespace {

constexpr std::string_view kTcp = "tcp://";

struct Endpoint {
    std::string host, port;
};

bool isPort(const std::string& text) {
    unsigned port = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
    return error == std::errc{} && end == text.data() + text.size() && port > 0 && port < 65536;
}

bool isHostName(const std::string& host) {
    return !host.empty() && host.size() < 254 && std::ranges::all_of(host, [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
               c == '.' || c == '-' || c == '_';
    });
}

// "[::1]" without its brackets, where it is an IPv6 address at all.
std::optional<std::string> ipv6In(const std::string& host) {
    if (host.size() < 4 || host.front() != '[' || host.back() != ']') return std::nullopt;
    std::string inner = host.substr(1, host.size() - 2);
    in6_addr parsed{};
    if (inet_pton(AF_INET6, inner.c_str(), &parsed) != 1) return std::nullopt;
    return inner;
}

Endpoint split(const std::string& address) {
    const std::size_t colon = address.rfind(':');
    if (!address.starts_with(kTcp) || colon == std::string::npos || colon < kTcp.size()) {
        throw Error("\"" + address + "\" is not an address; write it as tcp://HOST:PORT");
    }
    Endpoint endpoint{address.substr(kTcp.size(), colon - kTcp.size()), address.substr(colon + 1)};
    if (!isHostName(endpoint.host) && !ipv6In(endpoint.host)) {
        throw Error("\"" + address + "\" has no valid host; write it as tcp://HOST:PORT");
    }
    return endpoint;
}

[[noreturn]] void refusePort(const std::string& address) {
    throw Error("\"" + address + "\" has no valid port; use a number from 1 to 65535");
}

bool isLoopback(const std::string& host) {
    in_addr parsed{};
    if (inet_pton(AF_INET, host.c_str(), &parsed) == 1) return ntohl(parsed.s_addr) >> 24U == 127;
    return ipv6In(host) == "::1";
}

}  // namespace

void requireConnectAddress(const std::string& address) {
    if (!isPort(split(address).port)) refusePort(address);
}

std::string bindAddress(const std::string& address) {
    Endpoint endpoint = split(address);
    if (endpoint.host == "localhost") endpoint.host = "127.0.0.1";
    if (endpoint.port != "*" && !isPort(endpoint.port)) refusePort(address);
    if (!isLoopback(endpoint.host)) {
        throw Error("\"" + address +
                    "\" reaches past this machine, and without keys anybody there could take part; "
                    "use tcp://127.0.0.1:PORT");
    }
    return std::string(kTcp) + endpoint.host + ":" + endpoint.port;
}

}  // namespace aquarama::net
