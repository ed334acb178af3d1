// SPDX-License-Identifier: Apache-2.0
// How regularly frames are released, and how far apart in time the nodes let go of one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <vector>

#include "common/net/clock.h"
#include "common/wire/envelope.h"

namespace aquarama::conductor {

// The last ten seconds of something, at 60 Hz.
class RecentTimes {
  public:
    void add(net::Instant time);
    [[nodiscard]] float quantileMs(double quantile) const;  // 0 where there is nothing yet

  private:
    static constexpr std::size_t kKept = 600;
    std::deque<net::Instant> times_;
};

// Release skew of a frame: latest minus earliest node.
class SkewMeter {
  public:
    void add(const wire::ReleaseReport& report);
    [[nodiscard]] const RecentTimes& skews() const { return skews_; }

  private:
    struct Span {
        Frame frame;
        std::int64_t earliestNs, latestNs;
        int nodes;
    };
    static constexpr std::size_t kOpen = 8;  // frames whose reports may still be on their way
    std::deque<Span> spans_;
    RecentTimes skews_;
};

}  // namespace aquarama::conductor
