// SPDX-License-Identifier: Apache-2.0
// A port at which trackers are heard that speak TUIO.
#pragma once

#include <string>
#include <vector>

#include "common/config/host.h"
#include "common/tuio/hand_set.h"
#include "console/cues/udp_port.h"

namespace aquarama::console {

// One thread uses it.
class TrackerPort {
  public:
    // Listens; `from`: hosts whose packets count. Throws Error where it cannot.
    TrackerPort(const config::UdpAddress& at, std::vector<std::string> from)
        : port_{at}, from_{std::move(from)} {}

    // Takes what has come, at a time in seconds that never goes back; what is seen then.
    [[nodiscard]] std::vector<tuio::Hand> hear(double now);

    // Whether a host that counts has ever sent a packet.
    [[nodiscard]] bool isHeard() const { return isHeard_; }
    // The last host whose packets were dropped; empty: none.
    [[nodiscard]] const std::string& stranger() const { return stranger_; }

  private:
    UdpPort port_;
    std::vector<std::string> from_;
    tuio::HandSet seen_;
    bool isHeard_ = false;
    std::string stranger_;
};

}  // namespace aquarama::console
