// SPDX-License-Identifier: Apache-2.0
// What a node tells the master of its frames: which are finished, and how long they took.
#pragma once

#include <cstdint>
#include <optional>

#include "common/net/clock.h"
#include "common/wire/messages.h"
#include "render_node/session/mailbox.h"
#include "render_node/session/pings.h"

namespace aquarama::session {

// Used by the net thread.
class FrameReports {
  public:
    // The picture of a frame is finished.
    void finish(const FinishedFrame& finished);
    // The master has released this frame and all before it.
    void release(Frame frame);
    void forget() { finished_.reset(); }
    // Ready: after finish(), and again each 100 ms without a release. Empty while none is due.
    // Moments are converted to the master's clock. `mismatches`: of SchoolFollower.
    [[nodiscard]] std::optional<v1::Envelope> due(const Pings& clock,
                                                  net::Moment now,
                                                  std::uint64_t mismatches);
    [[nodiscard]] Frame lastFinished() const { return lastFinished_; }
    // How long the last 600 pictures took.
    void report(v1::NodeReport& report) const;

  private:
    std::optional<FinishedFrame> finished_;  // not released yet, as far as the node knows
    std::optional<net::Moment> said_;        // when it was last reported
    Frame lastFinished_;
    net::RecentTimes pictures_;
};

}  // namespace aquarama::session
