// SPDX-License-Identifier: Apache-2.0
// This machine's monotonic clock, real-time priority of threads, and the offset of the master's
// clock.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

namespace aquarama::net {

// A point in time, since the epoch of CLOCK_MONOTONIC of this machine, or of the master's where the
// name says so.
using Moment = std::chrono::steady_clock::time_point;
// The time between two moments.
using Duration = std::chrono::nanoseconds;

// A duration in seconds, for figures.
[[nodiscard]] inline double secondsIn(Duration duration) {
    return std::chrono::duration<double>(duration).count();
}

// Now, on CLOCK_MONOTONIC of this machine.
[[nodiscard]] Moment monotonicNow();
// The same in seconds.
[[nodiscard]] inline double monotonicSeconds() {
    return secondsIn(monotonicNow().time_since_epoch());
}

// Gives the calling thread real-time priority, or takes it away. The kernel then runs it as soon as
// it wakes, before threads without it. Threads that it starts later do not inherit it. False where
// the user lacks the permission.
bool runInRealTime(bool wanted = true);

// Whether this machine's clock is synchronised with other clocks, by chrony, ntpd or PTP.
[[nodiscard]] bool isClockSynchronised();

// The master's clock minus the node's, from round trips. A reply gives the offset to within half
// its round trip, and queues only make round trips longer. So it uses the shortest round trip of
// about each second. The clocks of two machines also run at different rates, 10 to 100 ppm apart.
// So after six seconds it fits a line through the offsets and follows that. Used by the net thread.
class ClockOffset {
  public:
    // A ping left at `sent`, was answered at `master` (master's clock) and came back at `received`.
    void add(Moment sent, Moment master, Moment received);
    // The offset at a moment of the node's clock; empty before the first round trip.
    [[nodiscard]] std::optional<Duration> offset(Moment now) const;
    [[nodiscard]] std::optional<Duration> roundTrip() const;  // the shortest of the last seconds
    // How much faster the master's clock runs, parts per million; 0 while it is unknown.
    [[nodiscard]] double driftPpm() const { return line_.slope * 1e6; }

  private:
    struct Sample {
        Moment at;  // of the node's clock, half-way
        Duration offset, roundTrip;
    };
    // offset = base + slope (now - at)
    struct Line {
        Moment at{};
        Duration base{};
        double slope = 0;
        bool isKnown = false;
    };
    [[nodiscard]] const Sample* best() const;
    // Keeps the best sample of the window, and fits the line again.
    void closeWindow();
    void fit();

    static constexpr std::size_t kSamples = 64;  // at 20 pings a second: 3 s
    static constexpr std::size_t kWindow = 16;
    static constexpr std::size_t kWindows = 32;      // 26 s
    static constexpr std::size_t kLeastWindows = 8;  // for a line
    static constexpr double kMostDrift = 500e-6;     // a larger value is noise, not drift
    std::deque<Sample> samples_, windows_;
    std::size_t sinceWindow_ = 0;
    Line line_;
};

// The vertical blanks of a display: one at `last`, and one at every `period` before and after it.
struct Blanks {
    Moment last{};
    Duration period{};
};

// Finds the period of a display from blanks that its driver counts and time-stamps.
class BlankMeter {
  public:
    // A blank of this count was at this moment.
    void add(std::uint64_t count, Moment at);
    // Empty until a second has passed without a jump.
    [[nodiscard]] std::optional<Blanks> blanks() const;

  private:
    struct Blank {
        std::uint64_t count;
        Moment at;
    };
    std::deque<Blank> seen_;  // of the last five seconds
};

// The last 600 durations: of frames, ten seconds at 60 Hz.
class RecentTimes {
  public:
    // The newest duration; the oldest is forgotten.
    void add(Duration time);
    [[nodiscard]] float quantileMs(
        double quantile) const;  // quantile 0 to 1; 0 where there is nothing yet
    // A histogram: for each edge the durations up to it and above the edge before; last those above
    // all edges. Edges ascend.
    [[nodiscard]] std::vector<std::uint32_t> countsUpTo(std::span<const Duration> edges) const;

  private:
    static constexpr std::size_t kKept = 600;
    std::deque<Duration> times_;
};

// The longest recent duration: of this tenth of a second, and of the last tenth before it that had
// any. A reader that asks ten times a second misses none.
class RecentPeak {
  public:
    // A duration that ended now.
    void add(Moment now, Duration time);
    [[nodiscard]] float ms() const;  // 0 where there is nothing yet

  private:
    Moment begun_{};  // this tenth of a second
    Duration before_{}, largest_{};
};

}  // namespace aquarama::net
