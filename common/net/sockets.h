// SPDX-License-Identifier: Apache-2.0
// What all channels over ZeroMQ have in common; included by the sources of this folder only.
// Messages are single-part (the ROUTER's address part aside), queues are short: a peer that stalls
// costs a few frames of memory and nobody else's time.
#pragma once

#include <atomic>
#include <functional>
#include <initializer_list>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include <zmq.hpp>

#include "common/net/channels.h"

namespace aquarama::net {

// Lets another thread end a poll on sockets.
class WakeEvent {
  public:
    WakeEvent();  // throws Error where there is no file descriptor left
    ~WakeEvent();
    WakeEvent(const WakeEvent&) = delete;
    WakeEvent& operator=(const WakeEvent&) = delete;

    void set() const;    // from any thread
    void clear() const;  // by the thread that polls
    [[nodiscard]] int descriptor() const { return descriptor_; }

  private:
    int descriptor_;
};

// A socket that queues so many messages each way, and cuts off a peer that sends a larger one.
[[nodiscard]] zmq::socket_t openSocket(zmq::context_t& context,
                                       zmq::socket_type type,
                                       int queue,
                                       std::size_t maxBytes);

// Over TCP. Throw Error: a malformed address, one past the loopback without keys, an occupied port.
void bindSocket(zmq::socket_t& socket, const std::string& address, bool hasKeys);
void connectSocket(zmq::socket_t& socket, const std::string& address);

// Before the socket is bound or connected: it speaks CURVE from now on. Throw Error where a key is
// none.
void requireKeys(zmq::socket_t& socket, const KeyPair& own);
void showKeys(zmq::socket_t& socket, const PeerKeys& keys);

// Says who may connect to the sockets of a context that require keys (ZAP, ZeroMQ's RFC 27), on a
// thread of its own: a flood of strangers takes no time from the frames. Made before the sockets,
// ended after them.
class Doorkeeper {
  public:
    Doorkeeper(zmq::context_t& context, std::function<Allowed()> allowed);
    ~Doorkeeper();
    Doorkeeper(const Doorkeeper&) = delete;
    Doorkeeper& operator=(const Doorkeeper&) = delete;

    [[nodiscard]] bool isAllowed(const std::string& user) const;
    // Whether a user has been taken from the list since the last call.
    [[nodiscard]] bool hasRevoked() { return revoked_.exchange(false); }

  private:
    // Of a user, in the last ten seconds.
    struct Handshakes {
        Instant since{};
        int count = 0;
    };
    void serve();
    void answer(zmq::socket_t& requests);
    // Empty where this key is not to be let in.
    [[nodiscard]] std::string userOf(const std::string& binaryKey);
    void readAgain();

    std::function<Allowed()> list_;
    mutable std::mutex mutex_;
    Allowed allowed_;
    std::map<std::string, Handshakes> handshakes_;  // by user
    std::atomic<bool> revoked_ = false;
    std::atomic<bool> ended_ = false;
    zmq::socket_t requests_;
    std::thread thread_;
};

// Where no space is left the message is dropped: the protocol repeats what matters.
void sendOrDrop(zmq::socket_t& socket, ByteView bytes);

// Never wait. False or empty: nothing has arrived. A message of several parts reads as empty bytes
// where one part is expected.
[[nodiscard]] bool receive(zmq::socket_t& socket, zmq::message_t& message);
[[nodiscard]] std::optional<ByteVector> receiveSingle(zmq::socket_t& socket);
// `first`: its first part, for what ZeroMQ knows of the sender.
[[nodiscard]] std::optional<ByteVector> receiveSingle(zmq::socket_t& socket, zmq::message_t& first);

// Waits until one of these sockets has a message, `wake` was set (it is cleared), a signal has
// come, or `atMost` is over.
void pollSockets(std::initializer_list<zmq::socket_t*> sockets,
                 const WakeEvent& wake,
                 Instant atMost);

}  // namespace aquarama::net
