// SPDX-License-Identifier: Apache-2.0
// Instants of this machine's monotonic clock, and how a node learns where the master's stands.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>

namespace aquarama::net {

// A moment or a duration of the monotonic clock.
using Instant = std::chrono::nanoseconds;  // since the epoch of CLOCK_MONOTONIC

// Now, on CLOCK_MONOTONIC of this machine.
[[nodiscard]] Instant monotonicNow();

// The master's clock minus the node's, from round trips. A reply tells the offset to within half
// its round trip, and queues only ever add to one: so the shortest of the last few is believed. Of
// the net thread.
class ClockOffset {
  public:
    // A ping left at `sent`, was answered at `master` (master's clock) and came back at `received`.
    void add(Instant sent, Instant master, Instant received);
    [[nodiscard]] std::optional<Instant> offset() const;
    [[nodiscard]] std::optional<Instant> roundTrip() const;  // of the sample that is believed

  private:
    struct Sample {
        Instant offset, roundTrip;
    };
    [[nodiscard]] const Sample* best() const;

    // At 20 pings a second: 3 s, in which crystals 50 ppm apart drift by 0.15 ms.
    static constexpr std::size_t kSamples = 64;
    std::deque<Sample> samples_;
};

}  // namespace aquarama::net
