// SPDX-License-Identifier: Apache-2.0
// Arbitration between pilots: the latest who begins to steer has control until he stops, sends
// nothing for half a second, or another begins.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "common/net/channels.h"
#include "common/net/clock.h"
#include "common/units/units.h"

namespace aquarama::conductor {

class InputArbitration {
  public:
    // The input of a pilot. True: it is applied to the submarine.
    [[nodiscard]] bool accepts(const net::PeerId& pilot,
                               const Steering& steering,
                               net::Instant now);
    // Who has control; empty: nobody.
    [[nodiscard]] std::optional<net::PeerId> pilot(net::Instant now) const;

  private:
    struct HeldInput {
        bool holds = false;
        net::Instant heard{};
    };
    [[nodiscard]] static bool holds(const HeldInput& input, net::Instant now);
    void forgetTheSilent(net::Instant now);

    std::map<net::PeerId, HeldInput> inputs_;
    net::PeerId holder_;
};

}  // namespace aquarama::conductor
