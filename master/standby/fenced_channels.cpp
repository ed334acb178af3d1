// SPDX-License-Identifier: Apache-2.0
#include "master/standby/fenced_channels.h"

#include <cstdint>

#include "common/wire/messages.h"

namespace aquarama::standby {

bool FencedChannels::isMute() const {
    return mastership_.revision() != 0 && !mastership_.isHeld();
}

std::optional<net::FromPeer> FencedChannels::receiveControl() {
    auto from = channels_->receiveControl();
    while (from && isMute()) from = channels_->receiveControl();
    return from;
}

// A packet is a message of protobuf: a field before it is a field of it.
std::optional<net::ByteVector> FencedChannels::withLease(net::ByteView bytes) const {
    const std::uint64_t revision = mastership_.revision();
    if (revision == 0) return net::ByteVector(bytes.begin(), bytes.end());
    if (!mastership_.isHeld()) return std::nullopt;
    net::ByteVector packet = wire::leaseField(revision);
    packet.insert(packet.end(), bytes.begin(), bytes.end());
    return packet;
}

void FencedChannels::sendControl(const net::PeerId& peer, net::ByteView bytes) {
    if (const auto packet = withLease(bytes)) channels_->sendControl(peer, *packet);
}

void FencedChannels::publishState(net::ByteView bytes) {
    if (const auto packet = withLease(bytes)) channels_->publishState(*packet);
}

}  // namespace aquarama::standby
