// SPDX-License-Identifier: Apache-2.0
// What tests of the parts of a conductor stand on, without sockets: the seats of the desk, and a
// record of what is sent.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/config/rig.h"
#include "common/net/channels.h"
#include "common/wire/messages.h"
#include "master/conductor/roster.h"
#include "master/conductor/sender.h"

namespace aquarama::test {

// The run of the master, and the moment at which its show starts.
inline constexpr std::uint64_t kRun = 77;
inline constexpr net::Moment kStart{std::chrono::seconds(100)};

// Three channels: left, middle and right.
inline config::Rig deskRig() {
    return config::readRig(AQUARAMA_SOURCE_DIR "/config/desk.txtpb");
}

// What was sent to one peer, decoded as a peer decodes it.
struct SentMessage {
    net::PeerId peer;
    v1::Envelope message;
};

// Channels that keep what is published, and hear nothing.
struct PublishedStates final : net::MasterChannels {
    std::vector<v1::Envelope> messages;

    void publishState(net::ByteView bytes) override {
        messages.push_back(wire::decode(bytes).value());
    }
    void sendControl(const net::PeerId& /*peer*/, net::ByteView /*bytes*/) override {}
    std::optional<net::FromPeer> receiveControl() override { return std::nullopt; }
    std::size_t discardNoise() override { return 0; }
    void wait(net::Duration /*atMost*/) override {}
    void wake() override {}
    std::string controlAddress() const override { return "memory:control"; }
    std::string stateAddress() const override { return "memory:state"; }

    [[nodiscard]] std::ptrdiff_t count(v1::Envelope::MessageCase kind) const {
        return std::ranges::count(messages, kind, &v1::Envelope::message_case);
    }
};

// A roster, and a sender that keeps what it sends.
struct Parts {
    std::vector<SentMessage> sent;
    conductor::Sender sender{kRun, [this](const net::PeerId& peer, net::ByteView packet) {
                                 sent.push_back({peer, wire::decode(packet).value()});
                             }};
    conductor::Roster roster{deskRig(), {}};

    Parts() = default;
    Parts(const Parts&) = delete;
    Parts& operator=(const Parts&) = delete;

    conductor::NodeSeat& seat(const std::string& name) {
        return roster.seats()[roster.named(name).value()];
    }
    // The node of the channel is there and takes part.
    conductor::NodeSeat& join(const std::string& name) {
        conductor::NodeSeat& joined = seat(name);
        joined.peer = "peer of " + name;
        joined.prepared = true;
        return joined;
    }
    // The number of messages of this kind to the node of a channel.
    [[nodiscard]] std::ptrdiff_t count(const std::string& name,
                                       v1::Envelope::MessageCase kind) const {
        return std::ranges::count_if(sent, [&](const SentMessage& one) {
            return one.peer == "peer of " + name && one.message.message_case() == kind;
        });
    }
};

}  // namespace aquarama::test
