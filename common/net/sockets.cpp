// SPDX-License-Identifier: Apache-2.0
#include "common/net/sockets.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <string_view>
#include <utility>

#include <arpa/inet.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include "common/base/log.h"

namespace aquarama::net {
namespace {

constexpr int kReconnectMs = 50;  // a restarted master is found within this time
constexpr int kReconnectMaxMs = 500;
constexpr int kHandshakeMs = 2000;  // after which a silent connection is closed
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

// Throws Error where it has no such parts; the port is checked by the caller.
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

// IPv6 only where the address has it: otherwise the bound address would be reported in IPv6 form.
void allowIpv6(zmq::socket_t& socket, const std::string& address) {
    socket.set(zmq::sockopt::ipv6, address.find('[') != std::string::npos);
}

}  // namespace

void requireConnectAddress(const std::string& address) {
    if (!isPort(split(address).port)) refusePort(address);
}

std::string bindAddress(const std::string& address, bool hasKeys) {
    Endpoint endpoint = split(address);
    if (endpoint.host == "localhost") endpoint.host = "127.0.0.1";
    if (endpoint.port != "*" && !isPort(endpoint.port)) refusePort(address);
    if (!isLoopback(endpoint.host) && !hasKeys) {
        throw Error("\"" + address +
                    "\" reaches past this machine, and without keys anybody there could take part; "
                    "make keys (aquarama keys new), or use tcp://127.0.0.1:PORT");
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

// A full counter cannot be raised and an empty one cannot be read; in both cases the state is
// already the wanted one.
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
    socket.set(zmq::sockopt::handshake_ivl, kHandshakeMs);
    return socket;
}

void bindSocket(zmq::socket_t& socket, const std::string& address, bool hasKeys) {
    const std::string checked = bindAddress(address, hasKeys);
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

namespace {

void setKeys(zmq::socket_t& socket, const KeyPair& own) {
    socket.set(zmq::sockopt::curve_publickey, own.publicKey);
    socket.set(zmq::sockopt::curve_secretkey, own.secretKey);
}

[[noreturn]] void refuseKeys() {
    throw Error("a key is not a valid CurveZMQ key; make new ones (aquarama keys new)");
}

}  // namespace

KeyPair makeKeyPair() {
    std::array<char, 41> publicKey{};
    std::array<char, 41> secretKey{};
    if (zmq_curve_keypair(publicKey.data(), secretKey.data()) != 0)
        throw Error("this libzmq cannot make keys; install one with libsodium");
    return {publicKey.data(), secretKey.data()};
}

void requireKeys(zmq::socket_t& socket, const KeyPair& own) {
    try {
        setKeys(socket, own);
        socket.set(zmq::sockopt::curve_server, true);
        socket.set(zmq::sockopt::zap_domain, "aquarama");
    } catch (const zmq::error_t&) {
        refuseKeys();
    }
}

void showKeys(zmq::socket_t& socket, const PeerKeys& keys) {
    try {
        setKeys(socket, keys.own);
        socket.set(zmq::sockopt::curve_serverkey, keys.master);
    } catch (const zmq::error_t&) {
        refuseKeys();
    }
}

Doorkeeper::Doorkeeper(zmq::context_t& context, std::function<Allowed()> allowed)
    : list_(std::move(allowed)),
      allowed_(list_ ? list_() : Allowed{}),
      requests_(context, zmq::socket_type::rep) {
    requests_.set(zmq::sockopt::linger, 0);
    requests_.bind("inproc://zeromq.zap.01");
    thread_ = std::thread([this] { serve(); });
}

Doorkeeper::~Doorkeeper() {
    ended_ = true;
    thread_.join();
}

bool Doorkeeper::isAllowed(const std::string& user) const {
    const std::lock_guard lock(mutex_);
    if (!list_) return true;
    return std::ranges::any_of(allowed_, [&](const auto& entry) { return entry.second == user; });
}

void Doorkeeper::serve() {
    constexpr std::chrono::milliseconds kBetweenLooks{100};
    Moment lastRead = monotonicNow();
    while (!ended_) {
        std::array items{zmq::pollitem_t{requests_.handle(), 0, ZMQ_POLLIN, 0}};
        try {
            zmq::poll(items.data(), items.size(), kBetweenLooks);
        } catch (const zmq::error_t&) {  // a signal
        }
        if ((items[0].revents & ZMQ_POLLIN) != 0) answer(requests_);
        if (!list_ || monotonicNow() - lastRead < std::chrono::seconds(1)) continue;
        readAgain();
        lastRead = monotonicNow();
    }
}

// A connection costs memory: a user that connects too often is refused for a while.
std::string Doorkeeper::userOf(const std::string& binaryKey) {
    constexpr int kMostHandshakes = 100;
    constexpr Duration kWithin = std::chrono::seconds(10);
    std::array<char, 41> key{};
    zmq_z85_encode(key.data(), reinterpret_cast<const std::uint8_t*>(binaryKey.data()), 32);
    const std::lock_guard lock(mutex_);
    const auto known = allowed_.find(key.data());
    if (list_ && known == allowed_.end()) return {};
    const std::string user = list_ ? known->second : "peer";
    Handshakes& handshakes = handshakes_[user];
    const Moment now = monotonicNow();
    if (now - handshakes.since > kWithin) handshakes = {now, 0};
    if (++handshakes.count <= kMostHandshakes) return user;
    if (handshakes.count == kMostHandshakes + 1)
        logWarning("{} connects more than {} times in ten seconds; refused for a while",
                   user,
                   kMostHandshakes);
    return {};
}

// Version, request, domain, address, identity, mechanism, key; the answer has version, request,
// status, its text, user, and metadata.
void Doorkeeper::answer(zmq::socket_t& requests) {
    std::vector<std::string> parts;
    zmq::message_t part;
    do {
        if (!receive(requests, part)) return;
        parts.push_back(part.to_string());
    } while (part.more());
    std::string user;
    if (parts.size() == 7 && parts[5] == "CURVE" && parts[6].size() == 32) user = userOf(parts[6]);
    const std::string request = parts.size() > 1 ? parts[1] : "";
    const std::array<std::string, 6> reply{
        "1.0", request, user.empty() ? "400" : "200", user.empty() ? "no such key" : "", user, ""};
    try {
        for (std::size_t i = 0; i < reply.size(); ++i)
            requests.send(zmq::buffer(reply[i]),
                          i + 1 < reply.size() ? zmq::send_flags::sndmore : zmq::send_flags::none);
    } catch (const zmq::error_t&) {  // the peer that asked has gone
    }
}

void Doorkeeper::readAgain() {
    Allowed now = list_();
    const std::lock_guard lock(mutex_);
    for (const auto& [key, user] : allowed_)
        if (!now.contains(key)) revoked_ = true;
    allowed_ = std::move(now);
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
    zmq::message_t first;
    return receiveSingle(socket, first);
}

std::optional<ByteVector> receiveSingle(zmq::socket_t& socket, zmq::message_t& first) {
    if (!receive(socket, first)) return std::nullopt;
    if (!first.more()) return bytesOf(first);
    zmq::message_t more;
    while (receive(socket, more) && more.more()) {
    }
    return ByteVector{};
}

void pollSockets(std::initializer_list<zmq::socket_t*> sockets,
                 const WakeEvent& wake,
                 Duration atMost) {
    std::array<zmq::pollitem_t, 3> items{};
    std::size_t count = 0;
    for (zmq::socket_t* socket : sockets) {
        items[count++] = {socket->handle(), 0, ZMQ_POLLIN, 0};
    }
    items[count++] = {nullptr, wake.descriptor(), ZMQ_POLLIN, 0};
    const auto ms = std::chrono::ceil<std::chrono::milliseconds>(std::max(atMost, Duration{0}));
    try {
        zmq::poll(items.data(), count, ms);
    } catch (const zmq::error_t&) {  // a signal: the caller checks its state and waits again
    }
    if ((items[count - 1].revents & ZMQ_POLLIN) != 0) wake.clear();
}

}  // namespace aquarama::net
