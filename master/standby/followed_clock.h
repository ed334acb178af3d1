// SPDX-License-Identifier: Apache-2.0
// At which tick the master's world is, by the clock of the machine that follows it.
#pragma once

#include <deque>
#include <optional>

#include "common/base/units.h"
#include "common/net/clock.h"

namespace aquarama::standby {

// From the ticks that the master has told and when they came. Networks and queues only delay them,
// so that the earliest counts, of the last two seconds: a master that was late goes on from there.
class FollowedClock {
  public:
    // The master has told this tick.
    void add(Tick tick, net::Moment came);
    // Another world begins.
    void forget() { beginnings_.clear(); }
    // Nothing before the first tick.
    [[nodiscard]] std::optional<Tick> tickAt(net::Moment now) const;

  private:
    // When tick 0 was, by one tick.
    struct Beginning {
        net::Moment came, at;
    };
    std::deque<Beginning> beginnings_;
};

}  // namespace aquarama::standby
