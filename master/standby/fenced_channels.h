// SPDX-License-Identifier: Apache-2.0
// The channels of a master of a rig with a standby: what it says carries its lease, and it says
// nothing while it may not be the master.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "common/lease/mastership.h"
#include "common/net/channels.h"

namespace aquarama::standby {

// Passes all on to other channels. Before this machine has been the master it may speak for itself,
// without a lease.
class FencedChannels final : public net::MasterChannels {
  public:
    // `mastership` outlives this.
    FencedChannels(std::unique_ptr<net::MasterChannels> channels,
                   const lease::Mastership& mastership)
        : channels_{std::move(channels)}, mastership_{mastership} {}

    void sendControl(const net::PeerId& peer, net::ByteView bytes) override;
    void publishState(net::ByteView bytes) override;
    // What comes while it says nothing is not heard either: it could not be answered.
    [[nodiscard]] std::optional<net::FromPeer> receiveControl() override;
    [[nodiscard]] std::size_t discardNoise() override { return channels_->discardNoise(); }
    void wait(net::Duration atMost) override { channels_->wait(atMost); }
    void wake() override { channels_->wake(); }
    [[nodiscard]] std::string controlAddress() const override {
        return channels_->controlAddress();
    }
    [[nodiscard]] std::string stateAddress() const override { return channels_->stateAddress(); }

  private:
    [[nodiscard]] bool isMute() const;
    // The packet with the lease; nothing where it must not be sent.
    [[nodiscard]] std::optional<net::ByteVector> withLease(net::ByteView bytes) const;

    std::unique_ptr<net::MasterChannels> channels_;
    const lease::Mastership& mastership_;
};

}  // namespace aquarama::standby
