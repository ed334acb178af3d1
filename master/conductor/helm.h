// SPDX-License-Identifier: Apache-2.0
// Whose hand steers, where several pilots are: the latest that takes hold. It has the helm until it
// lets go, falls silent, or another takes hold.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "common/net/channels.h"
#include "common/net/clock.h"
#include "common/units/steering.h"

namespace aquarama::conductor {

class Helm {
  public:
    // What a pilot's window says. True: the submarine is to hear it.
    [[nodiscard]] bool heeds(const net::PeerId& pilot, const Steering& steering, net::Instant now);
    // Who has it; empty: nobody.
    [[nodiscard]] std::optional<net::PeerId> pilot(net::Instant now) const;

  private:
    struct Hand {
        bool holds = false;
        net::Instant heard{};
    };
    [[nodiscard]] static bool holds(const Hand& hand, net::Instant now);
    void forgetTheSilent(net::Instant now);

    std::map<net::PeerId, Hand> hands_;
    net::PeerId holder_;
};

}  // namespace aquarama::conductor
