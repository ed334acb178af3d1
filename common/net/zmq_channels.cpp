// SPDX-License-Identifier: Apache-2.0
// The only place that sees ZeroMQ. Messages are single-part (the ROUTER's address part aside),
// queues are short: a peer that stalls costs a few frames of memory and nobody else's time.
#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>

#include <zmq.hpp>

#include "common/net/address.h"
#include "common/net/channels.h"
#include "common/net/wake_event.h"
#include "common/units/log.h"

namespace aquarama::net {
namespace {

constexpr int kStateQueue = 8;         // states in flight to one node, each way
constexpr int kControlQueue = 64;      // small messages
constexpr int kMasterLingerMs = 1000;  // how long a farewell may take to leave
constexpr int kNodeLingerMs = 200;
constexpr int kReconnectMs = 50;  // a master that restarts is found at once
constexpr int kReconnectMaxMs = 500;
constexpr int kMostRequests = 256;  // to the state channel in one turn: a flood stops no frame
constexpr std::size_t kSubscriptionBytes = 256;  // the longest that the state channel listens to

ByteVector bytesOf(const zmq::message_t& message) {
    const auto* first = message.data<std::byte>();
    return {first, first + message.size()};
}

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

// Only where it is asked for: else an address that was bound is reported in IPv6 clothes.
void allowIpv6(zmq::socket_t& socket, const std::string& address) {
    socket.set(zmq::sockopt::ipv6, address.find('[') != std::string::npos);
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

// Where no space is left the message is dropped: the protocol repeats what matters.
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

void skipParts(zmq::socket_t& socket, zmq::message_t& message) {
    while (message.more() && receive(socket, message)) {
    }
}

// A message of one part; any other is thrown away whole, and reads as empty bytes.
std::optional<ByteVector> receiveSingle(zmq::socket_t& socket) {
    zmq::message_t message;
    if (!receive(socket, message)) return std::nullopt;
    if (!message.more()) return bytesOf(message);
    skipParts(socket, message);
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

class ZmqMasterChannels final : public MasterChannels {
  public:
    ZmqMasterChannels(const std::string& controlAddress,
                      const std::string& stateAddress,
                      const PacketLimits& limits)
        : control_(openSocket(context_, zmq::socket_type::router, kControlQueue, limits.toMaster)),
          // Manual: a subscription counts only when we say so, so strangers cannot fill our memory
          // with topics.
          state_(openSocket(context_, zmq::socket_type::xpub, kStateQueue, kSubscriptionBytes)) {
        control_.set(zmq::sockopt::linger, kMasterLingerMs);
        state_.set(zmq::sockopt::linger, 0);
        state_.set(zmq::sockopt::xpub_manual, 1);
        bindSocket(control_, controlAddress);
        bindSocket(state_, stateAddress);
    }

    void sendControl(const PeerId& peer, ByteView bytes) override {
        try {
            const auto flags = zmq::send_flags::dontwait | zmq::send_flags::sndmore;
            if (!control_.send(zmq::buffer(peer), flags)) return;
        } catch (const zmq::error_t&) {
            return;
        }
        sendOrDrop(control_, bytes);
    }

    std::optional<FromPeer> receiveControl() override {
        zmq::message_t peer;
        if (!receive(control_, peer)) return std::nullopt;
        FromPeer from{peer.to_string(), {}};
        if (!peer.more()) return from;
        if (auto bytes = receiveSingle(control_)) from.bytes = std::move(*bytes);
        return from;
    }

    void publishState(ByteView bytes) override {
        admitSubscribers();
        sendOrDrop(state_, bytes);
    }

    std::size_t discardNoise() override {
        admitSubscribers();
        return std::exchange(noise_, 0);
    }

    void wait(Instant atMost) override { pollSockets({&control_, &state_}, wake_, atMost); }
    void wake() override { wake_.set(); }
    [[nodiscard]] std::string controlAddress() const override {
        return control_.get(zmq::sockopt::last_endpoint);
    }
    [[nodiscard]] std::string stateAddress() const override {
        return state_.get(zmq::sockopt::last_endpoint);
    }

  private:
    // "\x01" is a subscription to everything, the only one that we know; "\x00" ends it.
    void admitSubscribers() {
        for (int request = 0; request < kMostRequests; ++request) {
            const auto topic = receiveSingle(state_);
            if (!topic) return;
            const bool plain = topic->size() == 1;
            if (plain && topic->front() == std::byte{1}) {
                state_.set(zmq::sockopt::subscribe, "");
            } else if (plain && topic->front() == std::byte{0}) {
                state_.set(zmq::sockopt::unsubscribe, "");
            } else {
                ++noise_;
            }
        }
    }

    WakeEvent wake_;
    zmq::context_t context_{1};
    zmq::socket_t control_;
    zmq::socket_t state_;
    std::size_t noise_ = 0;
};

class ZmqNodeChannels final : public NodeChannels {
  public:
    ZmqNodeChannels(const std::string& controlAddress, const PacketLimits& limits)
        : maxBytes_(limits.toNode),
          control_(openSocket(context_, zmq::socket_type::dealer, kControlQueue, maxBytes_)) {
        control_.set(zmq::sockopt::linger, kNodeLingerMs);
        // What is said while nobody listens is dropped: a master that starts late is not greeted
        // by a heap of old hellos.
        control_.set(zmq::sockopt::immediate, true);
        connectSocket(control_, controlAddress);
    }

    void sendControl(ByteView bytes) override { sendOrDrop(control_, bytes); }
    std::optional<ByteVector> receiveControl() override { return receiveSingle(control_); }

    void subscribeState(const std::string& address) override {
        zmq::socket_t socket = openSocket(context_, zmq::socket_type::sub, kStateQueue, maxBytes_);
        socket.set(zmq::sockopt::subscribe, "");
        connectSocket(socket, address);
        state_ = std::move(socket);
    }

    std::optional<ByteVector> receiveState() override {
        return state_ ? receiveSingle(*state_) : std::nullopt;
    }

    void wait(Instant atMost) override {
        if (state_) {
            pollSockets({&control_, &*state_}, wake_, atMost);
        } else {
            pollSockets({&control_}, wake_, atMost);
        }
    }
    void wake() override { wake_.set(); }

  private:
    WakeEvent wake_;
    zmq::context_t context_{1};
    std::size_t maxBytes_;
    zmq::socket_t control_;
    std::optional<zmq::socket_t> state_;
};

}  // namespace

std::unique_ptr<MasterChannels> bindMaster(const std::string& controlAddress,
                                           const std::string& stateAddress,
                                           const PacketLimits& limits) {
    return std::make_unique<ZmqMasterChannels>(controlAddress, stateAddress, limits);
}

std::unique_ptr<NodeChannels> connectNode(const std::string& controlAddress,
                                          const PacketLimits& limits) {
    return std::make_unique<ZmqNodeChannels>(controlAddress, limits);
}

}  // namespace aquarama::net
