// SPDX-License-Identifier: Apache-2.0
// The channels of a show, as bytes: control in both directions and states one way between master
// and nodes, over ZeroMQ or in memory in tests; frames one way from a node to the program that
// encodes a clip.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/net/clock.h"

namespace aquarama::net {

using ByteView = std::span<const std::byte>;
using ByteVector = std::vector<std::byte>;

// A connection to the master, named by the master's socket; a new connection has a new name.
using PeerId = std::string;

// A packet that the master received. `user`: whose key the connection has shown; empty without
// keys.
struct FromPeer {
    PeerId peer;
    ByteVector bytes;
    std::string user = {};
};

// A pair of keys of CurveZMQ, Z85 text of 40 characters each.
struct KeyPair {
    std::string publicKey, secretKey;
};
// Of the system's random numbers.
[[nodiscard]] KeyPair makeKeyPair();

// By public key: the user of each that may connect.
using Allowed = std::map<std::string, std::string>;
// Of a master past the loopback. `allowed` is asked again once a second, on a thread of its own, so
// that a key can be revoked while a show runs; a user that is no longer in it is cut off. It must
// not throw.
struct MasterKeys {
    KeyPair own;
    std::function<Allowed()> allowed;
};
// Of whoever connects to it.
struct PeerKeys {
    std::string master;  // public
    KeyPair own;
};

// Largest packets that are accepted; a peer that sends a larger one is cut off.
struct PacketLimits {
    std::size_t toMaster = std::size_t{64} << 10U;
    std::size_t toNode = std::size_t{64} << 20U;
};

// The master's end. One thread uses it; only wake() may be called from others. Nothing blocks but
// wait(): a peer that does not read loses messages.
class MasterChannels {
  public:
    virtual ~MasterChannels() = default;
    virtual void sendControl(const PeerId& peer, ByteView bytes) = 0;
    [[nodiscard]] virtual std::optional<FromPeer> receiveControl() = 0;
    virtual void publishState(ByteView bytes) = 0;
    // What strangers sent to the state channel since the last call: counted and thrown away.
    [[nodiscard]] virtual std::size_t discardNoise() = 0;
    // Returns when something has arrived, after wake(), or after `atMost`.
    virtual void wait(Instant atMost) = 0;
    virtual void wake() = 0;
    // As bound, with the port that was chosen.
    [[nodiscard]] virtual std::string controlAddress() const = 0;
    [[nodiscard]] virtual std::string stateAddress() const = 0;
};

// A node's end; as above. What is said before the connection stands is lost.
class NodeChannels {
  public:
    virtual ~NodeChannels() = default;
    virtual void sendControl(ByteView bytes) = 0;
    [[nodiscard]] virtual std::optional<ByteVector> receiveControl() = 0;
    virtual void subscribeState(const std::string& address) = 0;
    [[nodiscard]] virtual std::optional<ByteVector> receiveState() = 0;
    virtual void wait(Instant atMost) = 0;
    virtual void wake() = 0;
};

// Makes a fresh connection to the master.
using Connect = std::function<std::unique_ptr<NodeChannels>()>;

// Throws Error where an address such as "tcp://127.0.0.1:7400" is malformed, before a socket sees
// it.
void requireConnectAddress(const std::string& address);
// The address to bind: port "*" is any free one, and "localhost", which may mean anything to a
// resolver, is 127.0.0.1. Throws Error where it is malformed, or where it reaches past this machine
// and there are no keys: everything past it is encrypted and authenticated.
[[nodiscard]] std::string bindAddress(const std::string& address, bool hasKeys = false);

// Over ZeroMQ, with keys by CURVE alone: who shows none that is allowed is not heard. Throws Error:
// malformed address, occupied port, an address past the loopback without keys, keys that are none.
[[nodiscard]] std::unique_ptr<MasterChannels> bindMaster(
    const std::string& controlAddress,
    const std::string& stateAddress,
    const PacketLimits& limits = {},
    const std::optional<MasterKeys>& keys = {});
[[nodiscard]] std::unique_ptr<NodeChannels> connectNode(const std::string& controlAddress,
                                                        const PacketLimits& limits = {},
                                                        const std::optional<PeerKeys>& keys = {});

// A frame of a channel on its way to a clip.
struct RawFrame {
    std::uint64_t frame = 0;
    std::int32_t width = 0, height = 0;  // pixels
    std::vector<std::uint16_t> rgb;      // codes of 8 bits, red green blue, top row first
};

// The file of the socket through which the frames of a channel pass, in a private folder of the
// run.
[[nodiscard]] std::filesystem::path frameSocket(const std::filesystem::path& folder,
                                                const std::string& channel);

// A node's end. Nothing waits on the disk: whoever draws waits for whoever encodes.
class FrameSender {
  public:
    // Waits until the receiver has taken all frames or has gone, a minute at most.
    virtual ~FrameSender() = default;
    // Waits while two frames are on their way. Throws Error when the receiver has gone.
    virtual void send(const RawFrame& frame) = 0;
};

// The end of the program that encodes the clip.
class FrameReceiver {
  public:
    virtual ~FrameReceiver() = default;
    // Waits for the next frame. Empty when the sender has ended and all its frames were received,
    // or when it has died; the last frames of one that died may be lost. Throws Error where
    // something that is no frame has come.
    [[nodiscard]] virtual std::optional<RawFrame> receive() = 0;
};

// Both take the path of frameSocket(); the order of starting does not matter. The sender waits up
// to half a minute for a receiver and throws Error where none comes. The receiver throws Error
// where it cannot listen there.
[[nodiscard]] std::unique_ptr<FrameSender> connectFrames(const std::filesystem::path& path);
[[nodiscard]] std::unique_ptr<FrameReceiver> bindFrames(const std::filesystem::path& path);

// A queue between two threads, of bounded length.

// One thread puts, one takes; a queue that is full holds up or refuses whoever puts. The lock is
// held for a move only, never across a call into a socket or a driver.
template <class T>
class BoundedQueue {
  public:
    explicit BoundedQueue(std::size_t capacity) : capacity_(capacity) {}

    // Waits while the queue is full. False: it was closed, nothing is put any more.
    bool put(T item) {
        std::unique_lock lock(mutex_);
        space_.wait(lock, [&] { return closed_ || items_.size() < capacity_; });
        if (closed_) return false;
        items_.push_back(std::move(item));
        return true;
    }

    // False: full or closed.
    bool tryPut(T item) {
        const std::lock_guard lock(mutex_);
        if (closed_ || items_.size() >= capacity_) return false;
        items_.push_back(std::move(item));
        return true;
    }

    // For the thread that puts: once false, it stays false until that thread puts again.
    [[nodiscard]] bool full() const {
        const std::lock_guard lock(mutex_);
        return items_.size() >= capacity_;
    }

    // The oldest; empty where there is none. Also after close(), until nothing is left.
    std::optional<T> tryTake() {
        const std::lock_guard lock(mutex_);
        if (items_.empty()) return std::nullopt;
        std::optional<T> first = std::move(items_.front());
        items_.pop_front();
        space_.notify_one();
        return first;
    }

    // Ends every wait; nothing is put from now on.
    void close() {
        const std::lock_guard lock(mutex_);
        closed_ = true;
        space_.notify_all();
    }

  private:
    mutable std::mutex mutex_;
    std::condition_variable space_;
    std::deque<T> items_;
    std::size_t capacity_;
    bool closed_ = false;
};

}  // namespace aquarama::net
