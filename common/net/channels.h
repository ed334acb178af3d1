// SPDX-License-Identifier: Apache-2.0
// The two ends of a cluster's network, as bytes: control in both directions, states one way. Over
// ZeroMQ (zmq_channels.cpp), or in memory in tests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/net/clock.h"

namespace aquarama::net {

using ByteView = std::span<const std::byte>;
using ByteVector = std::vector<std::byte>;

// A connection to the master, named by the master's socket; a new connection has a new name.
using PeerId = std::string;

struct FromPeer {
    PeerId peer;
    ByteVector bytes;
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
    [[nodiscard]] virtual std::string controlAddress() const = 0;  // as bound
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

// Over ZeroMQ. Throws Error: malformed address, occupied port, an address past the loopback.
[[nodiscard]] std::unique_ptr<MasterChannels> bindMaster(const std::string& controlAddress,
                                                         const std::string& stateAddress,
                                                         const PacketLimits& limits = {});
[[nodiscard]] std::unique_ptr<NodeChannels> connectNode(const std::string& controlAddress,
                                                        const PacketLimits& limits = {});

}  // namespace aquarama::net
