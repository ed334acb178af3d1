// SPDX-License-Identifier: Apache-2.0
#include "console/cues/tracker_port.h"

#include <algorithm>

#include "common/osc/osc.h"

namespace aquarama::console {

namespace {

// Of one call, of a tracker that speaks a hundred times a second; more wait.
constexpr int kMostTrackerPackets = 64;

}  // namespace

// What is malformed, or of somebody else, is dropped.
std::vector<tuio::Hand> TrackerPort::hear(double now) {
    for (int i = 0; i < kMostTrackerPackets; ++i) {
        const auto datagram = port_.receive(osc::kMostPacketBytes + 1);
        if (!datagram) break;
        if (std::ranges::find(from_, datagram->from.host) == from_.end()) {
            stranger_ = datagram->from.host;
            continue;
        }
        isHeard_ = true;
        seen_.hear(osc::decode(datagram->bytes).messages, now);
    }
    return seen_.seen(now);
}

}  // namespace aquarama::console
