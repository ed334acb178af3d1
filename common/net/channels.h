// SPDX-License-Identifier: Apache-2.0
// The channels of a show, as bytes. Control goes both ways between master and nodes, states go one
// way; over ZeroMQ, or in memory in tests. Frames go one way from a node to the program that
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

// The bytes of a packet: seen, and owned.
using ByteView = std::span<const std::byte>;
using ByteVector = std::vector<std::byte>;

// The name of a connection to the master, given by the master's socket; each new connection has a
// new name.
using PeerId = std::string;

// A packet that the master received. `user`: the owner of the key that the connection has shown;
// empty without keys.
struct FromPeer {
    PeerId peer;
    ByteVector bytes;
    std::string user = {};
};

// A pair of keys of CurveZMQ, Z85 text of 40 characters each.
struct KeyPair {
    std::string publicKey, secretKey;
};
// A new pair, from the system's random numbers.
[[nodiscard]] KeyPair makeKeyPair();

// The users that may connect, by public key.
using Allowed = std::map<std::string, std::string>;
// The keys of a master that other machines can reach. `allowed` is called once a second, on a
// separate thread, so that a key can be revoked while a show runs: a user that is no longer in it
// is disconnected. It must not throw. Without it whoever knows the public key of `own` may connect,
// as the user "peer".
struct MasterKeys {
    KeyPair own;
    std::function<Allowed()> allowed;
};
// The keys of a peer that connects to it.
struct PeerKeys {
    std::string master;  // its public key
    KeyPair own;
};

// Largest packets that are accepted; a peer that sends a larger one is disconnected.
struct PacketLimits {
    std::size_t toMaster = std::size_t{64} << 10U;
    std::size_t toNode = std::size_t{64} << 20U;
};

// The master's end. One thread uses it; only wake() may be called from others. Only wait() blocks:
// a peer that does not read loses messages.
class MasterChannels {
  public:
    virtual ~MasterChannels() = default;
    // Sends a packet to one peer; takes the oldest that one has sent, nothing where there is none;
    // sends a state to all who hear the state channel.
    virtual void sendControl(const PeerId& peer, ByteView bytes) = 0;
    [[nodiscard]] virtual std::optional<FromPeer> receiveControl() = 0;
    virtual void publishState(ByteView bytes) = 0;
    // The number of messages that unknown peers sent to the state channel since the last call. They
    // are discarded.
    [[nodiscard]] virtual std::size_t discardNoise() = 0;
    // Returns when something has arrived, after wake(), or after `atMost`.
    virtual void wait(Duration atMost) = 0;
    virtual void wake() = 0;
    // The addresses as bound, with the ports that were chosen.
    [[nodiscard]] virtual std::string controlAddress() const = 0;
    [[nodiscard]] virtual std::string stateAddress() const = 0;
};

// A node's end, with the same rules. Messages that are sent before the connection is established
// are lost.
class NodeChannels {
  public:
    virtual ~NodeChannels() = default;
    // Sends a packet to the master; takes the oldest that it has sent, nothing where there is none;
    // hears the state channel at this address from now on; takes the oldest state; waits until
    // something has arrived, wake(), or `atMost`; ends the wait, from any thread.
    virtual void sendControl(ByteView bytes) = 0;
    [[nodiscard]] virtual std::optional<ByteVector> receiveControl() = 0;
    virtual void subscribeState(const std::string& address) = 0;
    [[nodiscard]] virtual std::optional<ByteVector> receiveState() = 0;
    virtual void wait(Duration atMost) = 0;
    virtual void wake() = 0;
};

// Makes a fresh connection to the master.
using Connect = std::function<std::unique_ptr<NodeChannels>()>;
// Makes one to the master at an address.
using ConnectTo = std::function<std::unique_ptr<NodeChannels>(const std::string&)>;

// Throws Error where an address such as "tcp://127.0.0.1:7400" is malformed, before a socket sees
// it.
void requireConnectAddress(const std::string& address);
// The address to bind: port "*" is any free one; "localhost" is 127.0.0.1, as a resolver may return
// another address. Throws Error where it is malformed, or where it is open to other machines and
// there are no keys: such traffic must be encrypted and authenticated.
[[nodiscard]] std::string bindAddress(const std::string& address, bool hasKeys = false);

// The channels over ZeroMQ. With keys they accept CURVE only, and ignore peers without an allowed
// key. Throws Error: malformed address, occupied port, an address that is open to other machines
// without keys, invalid keys.
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

// The path of the socket for the frames of a channel, in a private folder of the run.
[[nodiscard]] std::filesystem::path frameSocket(const std::filesystem::path& folder,
                                                const std::string& channel);

// A node's end. Nothing is stored on disk: the node waits for the encoder.
class FrameSender {
  public:
    // Waits until the receiver has taken all frames or has gone, a minute at most.
    virtual ~FrameSender() = default;
    // Waits while two frames are in flight. Throws Error when the receiver has gone.
    virtual void send(const RawFrame& frame) = 0;
};

// The end of the program that encodes the clip.
class FrameReceiver {
  public:
    virtual ~FrameReceiver() = default;
    // Waits for the next frame. Empty when the sender has ended and all its frames were received,
    // or when it has died; its last frames may then be lost. Throws Error where a message is not a
    // frame.
    [[nodiscard]] virtual std::optional<RawFrame> receive() = 0;
};

// Both take the path of frameSocket(); the order of starting does not matter. The sender waits up
// to half a minute for a receiver and throws Error where none comes. The receiver throws Error
// where it cannot listen there.
[[nodiscard]] std::unique_ptr<FrameSender> connectFrames(const std::filesystem::path& path);
[[nodiscard]] std::unique_ptr<FrameReceiver> bindFrames(const std::filesystem::path& path);

// A queue between two threads, of bounded length.

// One thread puts, one takes. A full queue blocks the thread that puts, or refuses the item. The
// lock is held for a move only, never during a call into a socket or a driver.
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

    // Puts without waiting. False: full or closed.
    bool tryPut(T item) {
        const std::lock_guard lock(mutex_);
        if (closed_ || items_.size() >= capacity_) return false;
        items_.push_back(std::move(item));
        return true;
    }

    // For the thread that puts: once it is false, it stays false until that thread puts again.
    [[nodiscard]] bool full() const {
        const std::lock_guard lock(mutex_);
        return items_.size() >= capacity_;
    }

    // Takes the oldest item; empty where there is none. After close() the remaining items can still
    // be taken.
    std::optional<T> tryTake() {
        const std::lock_guard lock(mutex_);
        if (items_.empty()) return std::nullopt;
        std::optional<T> first = std::move(items_.front());
        items_.pop_front();
        space_.notify_one();
        return first;
    }

    // Ends every wait; nothing can be put from now on.
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
