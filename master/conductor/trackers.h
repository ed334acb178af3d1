// SPDX-License-Identifier: Apache-2.0
// Hands before the wall, from all trackers and windows that see some.
#pragma once

#include <cstdint>
#include <map>

#include "common/base/wall_hands.h"
#include "common/net/channels.h"
#include "common/net/clock.h"

namespace aquarama::conductor {

// Of the conductor's thread.
class Trackers {
  public:
    // What a tracker sees now. False: it speaks too often, or there are too many trackers, and it
    // is not heard.
    [[nodiscard]] bool hear(const net::PeerId& tracker, const WallHands& hands, net::Moment now);
    // The hands of all, with ids of their own; those of a tracker that has fallen silent are gone.
    [[nodiscard]] WallHands all(net::Moment now) const;

  private:
    struct Heard {
        std::uint32_t number = 0;  // of the tracker
        WallHands hands;
        net::Moment at{};
    };
    std::map<net::PeerId, Heard> heard_;
    std::uint32_t numbers_ = 0;
};

}  // namespace aquarama::conductor
