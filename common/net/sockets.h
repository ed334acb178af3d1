// SPDX-License-Identifier: Apache-2.0
// What all channels over ZeroMQ have in common; included by the sources of this folder only.
// Messages are single-part (the ROUTER's address part aside), queues are short: a peer that stalls
// costs a few frames of memory and nobody else's time.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>

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

// Over TCP. Throw Error: a malformed address, one past the loopback, an occupied port.
void bindSocket(zmq::socket_t& socket, const std::string& address);
void connectSocket(zmq::socket_t& socket, const std::string& address);

// Where no space is left the message is dropped: the protocol repeats what matters.
void sendOrDrop(zmq::socket_t& socket, ByteView bytes);

// Never wait. False or empty: nothing has arrived. A message of several parts reads as empty bytes
// where one part is expected.
[[nodiscard]] bool receive(zmq::socket_t& socket, zmq::message_t& message);
[[nodiscard]] std::optional<ByteVector> receiveSingle(zmq::socket_t& socket);

// Waits until one of these sockets has a message, `wake` was set (it is cleared), a signal has
// come, or `atMost` is over.
void pollSockets(std::initializer_list<zmq::socket_t*> sockets,
                 const WakeEvent& wake,
                 Instant atMost);

}  // namespace aquarama::net
