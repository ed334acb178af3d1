// SPDX-License-Identifier: Apache-2.0
// The channels between master and nodes, over ZeroMQ.
#include "common/net/channels.h"

#include <utility>

#include <zmq.hpp>

#include "common/base/log.h"
#include "common/net/sockets.h"

namespace aquarama::net {
namespace {

constexpr int kStateQueue = 8;         // states in flight to one node, each way
constexpr int kControlQueue = 64;      // small messages
constexpr int kMasterLingerMs = 1000;  // longest time to send a farewell
constexpr int kNodeLingerMs = 200;
constexpr int kMostRequests =
    256;  // to the state channel in one turn, so that a flood delays no frame
// Largest message to the state channel; a handshake with keys takes some 300 bytes.
constexpr std::size_t kSubscriptionBytes = 1024;

// Control on a ROUTER, which names its peers; states on an XPUB, which shows us subscriptions.
class ZmqMasterChannels final : public MasterChannels {
  public:
    ZmqMasterChannels(const std::string& controlAddress,
                      const std::string& stateAddress,
                      const PacketLimits& limits,
                      const std::optional<MasterKeys>& keys)
        : limits_(limits) {
        if (keys) {
            own_ = keys->own;
            door_.emplace(context_, keys->allowed);
        }
        openSockets();
        bindSocket(control_, controlAddress, door_.has_value());
        bindSocket(state_, stateAddress, door_.has_value());
        controlAddress_ = control_.get(zmq::sockopt::last_endpoint);
        stateAddress_ = state_.get(zmq::sockopt::last_endpoint);
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

    // A peer's name without a message reads as empty bytes.
    std::optional<FromPeer> receiveControl() override {
        zmq::message_t peer;
        if (!receive(control_, peer)) return std::nullopt;
        FromPeer from{peer.to_string(), {}};
        if (!peer.more()) return from;
        zmq::message_t content;
        auto bytes = receiveSingle(control_, content);
        if (door_) from.user = userOf(content);
        if (bytes && (!door_ || !from.user.empty())) from.bytes = std::move(*bytes);
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

    void wait(Duration atMost) override {
        if (door_ && door_->hasRevoked()) {
            openSockets();
            isBound_ = false;
        }
        if (!isBound_) bindAgain();
        pollSockets({&control_, &state_}, wake_, isBound_ ? atMost : std::min(atMost, kRetry));
    }
    void wake() override { wake_.set(); }
    [[nodiscard]] std::string controlAddress() const override { return controlAddress_; }
    [[nodiscard]] std::string stateAddress() const override { return stateAddress_; }

  private:
    // Replaces the sockets by new ones; the old connections end.
    void openSockets() {
        control_ = openSocket(context_, zmq::socket_type::router, kControlQueue, limits_.toMaster);
        // Manual mode: a subscription counts only when it is confirmed, so unknown peers cannot
        // fill the memory with topics.
        state_ = openSocket(context_, zmq::socket_type::xpub, kStateQueue, kSubscriptionBytes);
        control_.set(zmq::sockopt::linger, kMasterLingerMs);
        state_.set(zmq::sockopt::linger, 0);
        state_.set(zmq::sockopt::xpub_manual, 1);
        if (!door_) return;
        requireKeys(control_, own_);
        requireKeys(state_, own_);
    }

    // ZeroMQ frees an address some time after its socket was closed.
    void bindAgain() {
        try {
            if (control_.get(zmq::sockopt::last_endpoint).empty())
                bindSocket(control_, controlAddress_, true);
            bindSocket(state_, stateAddress_, true);
            isBound_ = true;
        } catch (const Error&) {  // not free yet
        }
    }

    // The content of a message from a peer that has shown a key always has it; the peer's name,
    // which ZeroMQ puts before it, does not.
    static std::string userOf(const zmq::message_t& part) {
        const char* const user = zmq_msg_gets(part.handle(), "User-Id");
        return user == nullptr ? "" : user;
    }

    // "\x01" is a subscription to everything, the only one that is used; "\x00" ends it.
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

    static constexpr Duration kRetry = std::chrono::milliseconds(10);
    PacketLimits limits_;
    KeyPair own_;
    WakeEvent wake_;
    zmq::context_t context_{1};
    std::optional<Doorkeeper> door_;  // with keys
    zmq::socket_t control_;
    zmq::socket_t state_;
    std::string controlAddress_, stateAddress_;  // as bound
    bool isBound_ = true;                        // false for a moment after a key was revoked
    std::size_t noise_ = 0;
};

// Control on a DEALER, states on a SUB.
class ZmqNodeChannels final : public NodeChannels {
  public:
    ZmqNodeChannels(const std::string& controlAddress,
                    const PacketLimits& limits,
                    const std::optional<PeerKeys>& keys)
        : keys_(keys),
          maxBytes_(limits.toNode),
          control_(openSocket(context_, zmq::socket_type::dealer, kControlQueue, maxBytes_)) {
        control_.set(zmq::sockopt::linger, kNodeLingerMs);
        // Messages without a connection are dropped: a master that starts late does not receive
        // many old hellos.
        control_.set(zmq::sockopt::immediate, true);
        if (keys_) showKeys(control_, *keys_);
        connectSocket(control_, controlAddress);
    }

    void sendControl(ByteView bytes) override { sendOrDrop(control_, bytes); }
    std::optional<ByteVector> receiveControl() override { return receiveSingle(control_); }

    void subscribeState(const std::string& address) override {
        zmq::socket_t socket = openSocket(context_, zmq::socket_type::sub, kStateQueue, maxBytes_);
        socket.set(zmq::sockopt::subscribe, "");
        if (keys_) showKeys(socket, *keys_);
        connectSocket(socket, address);
        state_ = std::move(socket);
    }

    std::optional<ByteVector> receiveState() override {
        return state_ ? receiveSingle(*state_) : std::nullopt;
    }

    void wait(Duration atMost) override {
        if (state_) {
            pollSockets({&control_, &*state_}, wake_, atMost);
        } else {
            pollSockets({&control_}, wake_, atMost);
        }
    }
    void wake() override { wake_.set(); }

  private:
    std::optional<PeerKeys> keys_;
    WakeEvent wake_;
    zmq::context_t context_{1};
    std::size_t maxBytes_;
    zmq::socket_t control_;
    std::optional<zmq::socket_t> state_;
};

}  // namespace

std::unique_ptr<MasterChannels> bindMaster(const std::string& controlAddress,
                                           const std::string& stateAddress,
                                           const PacketLimits& limits,
                                           const std::optional<MasterKeys>& keys) {
    return std::make_unique<ZmqMasterChannels>(controlAddress, stateAddress, limits, keys);
}

std::unique_ptr<NodeChannels> connectNode(const std::string& controlAddress,
                                          const PacketLimits& limits,
                                          const std::optional<PeerKeys>& keys) {
    return std::make_unique<ZmqNodeChannels>(controlAddress, limits, keys);
}

}  // namespace aquarama::net
