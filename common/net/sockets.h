// SPDX-License-Identifier: Apache-2.0
// Sockets of ZeroMQ, as all channels use them; included by the sources of this folder only. A
// message has a single part, besides the address of a ROUTER. Queues are short: a stalled peer
// costs memory for a few frames, and no time of others.
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
    // The file descriptor that is polled.
    [[nodiscard]] int descriptor() const { return descriptor_; }

  private:
    int descriptor_;
};

// A socket with queues of this length in each direction. It disconnects a peer that sends a larger
// message.
[[nodiscard]] zmq::socket_t openSocket(zmq::context_t& context,
                                       zmq::socket_type type,
                                       int queue,
                                       std::size_t maxBytes);

// Bind and connect over TCP. Throw Error: a malformed address, one that is open to other machines
// without keys, an occupied port.
void bindSocket(zmq::socket_t& socket, const std::string& address, bool hasKeys);
void connectSocket(zmq::socket_t& socket, const std::string& address);

// Switch the socket to CURVE, before it is bound or connected. Throw Error where a key is invalid.
void requireKeys(zmq::socket_t& socket, const KeyPair& own);
void showKeys(zmq::socket_t& socket, const PeerKeys& keys);

// Decides which peers may connect to the sockets of a context that require keys (ZAP, ZeroMQ's RFC
// 27). It runs on its own thread, so that a flood of unknown peers takes no time from the frames.
// Construct it before the sockets, and destroy it after them.
class Doorkeeper {
  public:
    Doorkeeper(zmq::context_t& context, std::function<Allowed()> allowed);
    ~Doorkeeper();
    Doorkeeper(const Doorkeeper&) = delete;
    Doorkeeper& operator=(const Doorkeeper&) = delete;

    // Whether this user may connect now. From any thread.
    [[nodiscard]] bool isAllowed(const std::string& user) const;
    // Whether a user has been taken from the list since the last call.
    [[nodiscard]] bool hasRevoked() { return revoked_.exchange(false); }

  private:
    // Handshakes of a user in the last ten seconds.
    struct Handshakes {
        Moment since{};
        int count = 0;
    };
    void serve();
    void answer(zmq::socket_t& requests);
    // The user of this key; empty where it may not connect.
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

// Sends a message, or drops it where the queue is full: the protocol repeats important messages.
void sendOrDrop(zmq::socket_t& socket, ByteView bytes);

// Receive without waiting. False or empty: nothing has arrived. A message of several parts reads as
// empty bytes where one part is expected.
[[nodiscard]] bool receive(zmq::socket_t& socket, zmq::message_t& message);
[[nodiscard]] std::optional<ByteVector> receiveSingle(zmq::socket_t& socket);
// `first`: the first part, which has ZeroMQ's properties of the sender.
[[nodiscard]] std::optional<ByteVector> receiveSingle(zmq::socket_t& socket, zmq::message_t& first);

// Waits until one of these sockets has a message, `wake` was set (it is cleared), a signal has
// come, or `atMost` is over.
void pollSockets(std::initializer_list<zmq::socket_t*> sockets,
                 const WakeEvent& wake,
                 Duration atMost);

}  // namespace aquarama::net
