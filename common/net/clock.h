// SPDX-License-Identifier: Apache-2.0
// Instants of this machine's monotonic clock, threads that wake on time, and how a node learns
// where the master's stands.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <vector>

namespace aquarama::net {

// A moment or a duration of the monotonic clock.
using Instant = std::chrono::nanoseconds;  // since the epoch of CLOCK_MONOTONIC

// For figures.
[[nodiscard]] inline double secondsIn(Instant duration) {
    return std::chrono::duration<double>(duration).count();
}

// Now, on CLOCK_MONOTONIC of this machine.
[[nodiscard]] Instant monotonicNow();

// Asks the kernel to run the calling thread as soon as it wakes, before all that has no such
// priority; threads that it starts later have none. Or ends that. False where this user may not.
bool runInRealTime(bool wanted = true);

// Whether the kernel holds this machine's clock to others', by chrony, ntpd or PTP.
[[nodiscard]] bool isClockSynchronised();

// The master's clock minus the node's, from round trips. A reply tells the offset to within half
// its round trip, and queues only ever add to one: so the shortest of every second or so is
// believed. Clocks of two machines also run at different rates, some 10 to 100 ppm apart: after six
// seconds a line is laid through what was believed, and followed. Of the net thread.
class ClockOffset {
  public:
    // A ping left at `sent`, was answered at `master` (master's clock) and came back at `received`.
    void add(Instant sent, Instant master, Instant received);
    // At a moment of the node's clock; empty before the first round trip.
    [[nodiscard]] std::optional<Instant> offset(Instant now) const;
    [[nodiscard]] std::optional<Instant> roundTrip() const;  // the shortest of the last seconds
    // By how much the master's clock runs faster, parts per million; 0 while it is not known.
    [[nodiscard]] double driftPpm() const { return line_.slope * 1e6; }

  private:
    struct Sample {
        Instant at;  // of the node's clock, half-way
        Instant offset, roundTrip;
    };
    // offset = base + slope (now - at)
    struct Line {
        Instant at{}, base{};
        double slope = 0;
        bool isKnown = false;
    };
    [[nodiscard]] const Sample* best() const;
    // Keeps the best of the samples that make a window, and fits the line again.
    void closeWindow();
    void fit();

    static constexpr std::size_t kSamples = 64;  // at 20 pings a second: 3 s
    static constexpr std::size_t kWindow = 16;
    static constexpr std::size_t kWindows = 32;      // 26 s
    static constexpr std::size_t kLeastWindows = 8;  // for a line
    static constexpr double kMostDrift = 500e-6;     // more is no clock's drift, but noise
    std::deque<Sample> samples_, windows_;
    std::size_t sinceWindow_ = 0;
    Line line_;
};

// The vertical blanks of a display: at `last`, and at every `period` before and after it.
struct Blanks {
    Instant last{}, period{};
};

// Finds the period of a display from blanks that its driver counts and dates.
class BlankMeter {
  public:
    void add(std::uint64_t count, Instant at);
    // Empty until a second has been seen without a jump.
    [[nodiscard]] std::optional<Blanks> blanks() const;

  private:
    struct Blank {
        std::uint64_t count;
        Instant at;
    };
    std::deque<Blank> seen_;  // of the last five seconds
};

// The last 600 durations: of frames, ten seconds at 60 Hz.
class RecentTimes {
  public:
    void add(Instant time);
    [[nodiscard]] float quantileMs(
        double quantile) const;  // quantile 0 to 1; 0 where there is nothing yet
    // How many are up to each of these edges, which ascend, and above the one before; last those
    // above all.
    [[nodiscard]] std::vector<std::uint32_t> countsUpTo(std::span<const Instant> edges) const;

  private:
    static constexpr std::size_t kKept = 600;
    std::deque<Instant> times_;
};

// The longest of a few recent durations: of this tenth of a second and of the one before in which
// there were any. So whoever asks ten times a second misses none.
class RecentPeak {
  public:
    void add(Instant now, Instant time);
    [[nodiscard]] float ms() const;  // 0 where there is nothing yet

  private:
    Instant begun_{}, before_{}, largest_{};
};

}  // namespace aquarama::net
