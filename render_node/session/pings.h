// SPDX-License-Identifier: Apache-2.0
// A node's pings to the master: they tell the offset of the master's clock, and the state of the
// network between them.
#pragma once

#include <deque>
#include <optional>
#include <utility>

#include "common/net/clock.h"
#include "common/wire/messages.h"

namespace aquarama::session {

// Used by the net thread.
class Pings {
  public:
    static constexpr net::Duration kInterval = std::chrono::milliseconds(50);

    // The ping to send now; empty while none is due.
    [[nodiscard]] std::optional<v1::Envelope> due(net::Moment now);
    void hear(const v1::Pong& pong, net::Moment now);
    // The master's clock minus this machine's; empty before the first answer.
    [[nodiscard]] std::optional<net::Duration> offset(net::Moment now) const {
        return clock_.offset(now);
    }
    // Of the last ten seconds: round trips, their jitter, and the share without an answer.
    void report(v1::NodeReport& report, net::Moment now) const;

  private:
    net::ClockOffset clock_;
    // When a ping was sent, and how long its answer took.
    std::deque<std::pair<net::Moment, std::optional<net::Duration>>> sent_;
    net::Moment last_{};
};

}  // namespace aquarama::session
