// SPDX-License-Identifier: Apache-2.0
#include "common/net/clock.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <sched.h>
#include <sys/timex.h>

namespace aquarama::net {

Moment monotonicNow() {
    return std::chrono::steady_clock::now();
}

bool runInRealTime(bool wanted) {
    // Calls the kernel directly. With pthread_setschedparam the C library would remember the
    // priority and pass it on to new threads, but the kernel resets theirs. On this conflict libzmq
    // 4.3.5 ends the process.
    const sched_param priority{.sched_priority = wanted ? 10 : 0};
    const int policy = wanted ? SCHED_RR : SCHED_OTHER;
    return sched_setscheduler(0, policy | SCHED_RESET_ON_FORK, &priority) == 0;
}

bool isClockSynchronised() {
    timex asked{};
    return adjtimex(&asked) != TIME_ERROR && (asked.status & STA_UNSYNC) == 0;
}

void ClockOffset::add(Moment sent, Moment master, Moment received) {
    if (received < sent) return;  // not the echo of a ping of this clock
    const Duration roundTrip = received - sent;
    const Moment middle = sent + roundTrip / 2;
    samples_.push_back({middle, master - middle, roundTrip});
    if (samples_.size() > kSamples) samples_.pop_front();
    if (++sinceWindow_ == kWindow) closeWindow();
}

// The sample with the shortest round trip; null before the first one.
const ClockOffset::Sample* ClockOffset::best() const {
    const auto shortest = std::ranges::min_element(samples_, {}, &Sample::roundTrip);
    return shortest == samples_.end() ? nullptr : &*shortest;
}

void ClockOffset::closeWindow() {
    sinceWindow_ = 0;
    const auto first = samples_.end() - static_cast<std::ptrdiff_t>(kWindow);
    windows_.push_back(
        *std::min_element(first, samples_.end(), [](const Sample& a, const Sample& b) {
            return a.roundTrip < b.roundTrip;
        }));
    if (windows_.size() > kWindows) windows_.pop_front();
    fit();
}

// Least squares. The weight of a sample is the inverse square of its round trip, which is its
// possible error.
void ClockOffset::fit() {
    line_ = {};
    if (windows_.size() < kLeastWindows) return;
    const Moment at = windows_.front().at;
    const Duration base = windows_.front().offset;
    double sum = 0, t = 0, o = 0, tt = 0, to = 0;
    for (const Sample& sample : windows_) {
        const double error = static_cast<double>(sample.roundTrip.count()) + 1000;
        const double weight = 1e6 / (error * error);
        const auto time = static_cast<double>((sample.at - at).count());
        const auto offset = static_cast<double>((sample.offset - base).count());
        sum += weight;
        t += weight * time;
        o += weight * offset;
        tt += weight * time * time;
        to += weight * time * offset;
    }
    const double spread = sum * tt - t * t;
    if (spread <= 0) return;
    const double slope = (sum * to - t * o) / spread;
    if (std::abs(slope) > kMostDrift) return;
    const auto atZero = static_cast<std::int64_t>((o - slope * t) / sum);
    line_ = {at, base + Duration{atZero}, slope, true};
}

std::optional<Duration> ClockOffset::offset(Moment now) const {
    const Sample* sample = best();
    if (sample == nullptr) return std::nullopt;
    if (!line_.isKnown) return sample->offset;
    const double drifted = line_.slope * static_cast<double>((now - line_.at).count());
    return line_.base + Duration{static_cast<std::int64_t>(drifted)};
}

std::optional<Duration> ClockOffset::roundTrip() const {
    const Sample* sample = best();
    return sample != nullptr ? std::optional{sample->roundTrip} : std::nullopt;
}

namespace {

// Limits of the time between two blanks; the refresh rate of any display is well within.
constexpr Duration kShortestPeriod = std::chrono::milliseconds(2);
constexpr Duration kLongestPeriod = std::chrono::milliseconds(100);

Duration periodBetween(const auto& first, const auto& last) {
    return (last.at - first.at) / static_cast<std::int64_t>(last.count - first.count);
}

}  // namespace

void BlankMeter::add(std::uint64_t count, Moment at) {
    constexpr Duration kKept = std::chrono::seconds(5);
    const Blank blank{count, at};
    if (!seen_.empty() && count == seen_.back().count) return;
    // The mode or the display has changed, or the driver uses another clock.
    if (!seen_.empty() && (count < seen_.back().count || at <= seen_.back().at ||
                           periodBetween(seen_.back(), blank) < kShortestPeriod ||
                           periodBetween(seen_.back(), blank) > kLongestPeriod))
        seen_.clear();
    seen_.push_back(blank);
    while (at - seen_.front().at > kKept) seen_.pop_front();
}

std::optional<Blanks> BlankMeter::blanks() const {
    constexpr Duration kLeast = std::chrono::seconds(1);
    if (seen_.empty() || seen_.back().at - seen_.front().at < kLeast) return std::nullopt;
    return Blanks{seen_.back().at, periodBetween(seen_.front(), seen_.back())};
}

void RecentTimes::add(Duration time) {
    times_.push_back(time);
    if (times_.size() > kKept) times_.pop_front();
}

std::vector<std::uint32_t> RecentTimes::countsUpTo(std::span<const Duration> edges) const {
    std::vector<std::uint32_t> counts(edges.size() + 1, 0);
    for (const Duration time : times_)
        ++counts[static_cast<std::size_t>(std::ranges::lower_bound(edges, time) - edges.begin())];
    return counts;
}

void RecentPeak::add(Moment now, Duration time) {
    constexpr Duration kTenth = std::chrono::milliseconds(100);
    if (now - begun_ >= kTenth) {
        before_ = std::exchange(largest_, Duration{});
        begun_ = now;
    }
    largest_ = std::max(largest_, time);
}
float RecentPeak::ms() const {
    return std::chrono::duration<float, std::milli>(std::max(before_, largest_)).count();
}
float RecentTimes::quantileMs(double quantile) const {
    assert(quantile >= 0);
    assert(quantile <= 1);
    if (times_.empty()) return 0.0F;
    std::vector<Duration> sorted(times_.begin(), times_.end());
    const auto rank =
        static_cast<std::ptrdiff_t>(quantile * static_cast<double>(sorted.size() - 1));
    std::nth_element(sorted.begin(), sorted.begin() + rank, sorted.end());
    return std::chrono::duration<float, std::milli>(sorted[static_cast<std::size_t>(rank)]).count();
}

}  // namespace aquarama::net
