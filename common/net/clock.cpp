// SPDX-License-Identifier: Apache-2.0
#include "common/net/clock.h"

#include <algorithm>

namespace aquarama::net {

Instant monotonicNow() {
    return std::chrono::duration_cast<Instant>(std::chrono::steady_clock::now().time_since_epoch());
}

void ClockOffset::add(Instant sent, Instant master, Instant received) {
    if (received < sent) return;  // an echo of something that this clock never said
    const Instant roundTrip = received - sent;
    samples_.push_back({master - (sent + roundTrip / 2), roundTrip});
    if (samples_.size() > kSamples) samples_.pop_front();
}

// The sample with the shortest round trip; null where there is none yet.
const ClockOffset::Sample* ClockOffset::best() const {
    const auto shortest = std::ranges::min_element(samples_, {}, &Sample::roundTrip);
    return shortest == samples_.end() ? nullptr : &*shortest;
}

std::optional<Instant> ClockOffset::offset() const {
    const Sample* sample = best();
    return sample != nullptr ? std::optional{sample->offset} : std::nullopt;
}

std::optional<Instant> ClockOffset::roundTrip() const {
    const Sample* sample = best();
    return sample != nullptr ? std::optional{sample->roundTrip} : std::nullopt;
}

}  // namespace aquarama::net
