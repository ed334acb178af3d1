// SPDX-License-Identifier: Apache-2.0
#include "common/net/sockets.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <string_view>

#include <arpa/inet.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "common/base/log.h"

namespace aquarama::net {
namespace {

constexpr int kReconnectMs = 50;  // a master that restarts is found at once
constexpr int kReconnectMaxMs = 500;
constexpr std::string_view kTcp = "tcp://";

// An address "tcp://HOST:PORT" in its parts.
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

// Throws Error where it has no such parts; the port is left to the caller.
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

// All of 127.0.0.0/8, and ::1; names are not resolved.
bool isLoopback(const std::string& host) {
    in_addr parsed{};
    if (inet_pton(AF_INET, host.c_str(), &parsed) == 1) return ntohl(parsed.s_addr) >> 24U == 127;
    return ipv6In(host) == "::1";
}

ByteVector bytesOf(const zmq::message_t& message) {
    const auto* first = message.data<std::byte>();
    return {first, first + message.size()};
}

// Only where it is asked for: else the address that was bound is reported in IPv6 form.
void allowIpv6(zmq::socket_t& socket, const std::string& address) {
    socket.set(zmq::sockopt::ipv6, address.find('[') != std::string::npos);
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

WakeEvent::WakeEvent() : descriptor_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
    if (descriptor_ < 0) {
        throw Error("no file descriptor left for a network thread; raise the limit (ulimit -n)");
    }
}

WakeEvent::~WakeEvent() {
    close(descriptor_);
}

// A full counter cannot be raised further and an empty one not be read: both mean what is wanted.
void WakeEvent::set() const {
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = write(descriptor_, &one, sizeof one);
}

void WakeEvent::clear() const {
    std::uint64_t count = 0;
    [[maybe_unused]] const auto taken = read(descriptor_, &count, sizeof count);
}

// Both queues have the same bound; zero would mean none.
zmq::socket_t openSocket(zmq::context_t& context,
                         zmq::socket_type type,
                         int queue,
                         std::size_t maxBytes) {
    zmq::socket_t socket(context, type);
    socket.set(zmq::sockopt::sndhwm, queue);
    socket.set(zmq::sockopt::rcvhwm, queue);
    socket.set(zmq::sockopt::maxmsgsize, static_cast<std::int64_t>(maxBytes));
    return socket;
}

void bindSocket(zmq::socket_t& socket, const std::string& address) {
    const std::string checked = bindAddress(address);
    allowIpv6(socket, checked);
    try {
        socket.bind(checked);
    } catch (const zmq::error_t& error) {
        const bool occupied = error.num() == EADDRINUSE;
        throw Error("cannot listen at " + address + ": " + error.what() +
                    (occupied ? "; stop the other master there, or choose another port in the rig"
                              : "; choose another address in the rig"));
    }
}

void connectSocket(zmq::socket_t& socket, const std::string& address) {
    requireConnectAddress(address);
    allowIpv6(socket, address);
    socket.set(zmq::sockopt::reconnect_ivl, kReconnectMs);
    socket.set(zmq::sockopt::reconnect_ivl_max, kReconnectMaxMs);
    try {
        socket.connect(address);
    } catch (const zmq::error_t& error) {
        throw Error("cannot connect to " + address + ": " + error.what() +
                    "; check the master's address");
    }
}

void sendOrDrop(zmq::socket_t& socket, ByteView bytes) {
    try {
        [[maybe_unused]] const auto sent =
            socket.send(zmq::const_buffer(bytes.data(), bytes.size()), zmq::send_flags::dontwait);
    } catch (const zmq::error_t&) {  // interrupted, or the connection is gone
    }
}

bool receive(zmq::socket_t& socket, zmq::message_t& message) {
    try {
        return socket.recv(message, zmq::recv_flags::dontwait).has_value();
    } catch (const zmq::error_t&) {
        return false;
    }
}

std::optional<ByteVector> receiveSingle(zmq::socket_t& socket) {
    zmq::message_t message;
    if (!receive(socket, message)) return std::nullopt;
    if (!message.more()) return bytesOf(message);
    while (message.more() && receive(socket, message)) {
    }
    return ByteVector{};
}

void pollSockets(std::initializer_list<zmq::socket_t*> sockets,
                 const WakeEvent& wake,
                 Instant atMost) {
    std::array<zmq::pollitem_t, 3> items{};
    std::size_t count = 0;
    for (zmq::socket_t* socket : sockets) {
        items[count++] = {socket->handle(), 0, ZMQ_POLLIN, 0};
    }
    items[count++] = {nullptr, wake.descriptor(), ZMQ_POLLIN, 0};
    const auto ms = std::chrono::ceil<std::chrono::milliseconds>(std::max(atMost, Instant{0}));
    try {
        zmq::poll(items.data(), count, ms);
    } catch (const zmq::error_t&) {  // a signal: the caller looks around and waits again
    }
    if ((items[count - 1].revents & ZMQ_POLLIN) != 0) wake.clear();
}

}  // namespace aquarama::net
