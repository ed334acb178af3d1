// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/meters.h"

namespace aquarama::conductor {

void RecentTimes::add(net::Instant time) {
    times_.push_back(time);
    if (times_.size() > kKept) times_.pop_front();
}

float RecentTimes::quantileMs(double quantile) const {
    if (times_.empty()) return 0.0F;
    std::vector<net::Instant> sorted(times_.begin(), times_.end());
    const auto rank =
        static_cast<std::ptrdiff_t>(quantile * static_cast<double>(sorted.size() - 1));
    std::nth_element(sorted.begin(), sorted.begin() + rank, sorted.end());
    return std::chrono::duration<float, std::milli>(sorted[static_cast<std::size_t>(rank)]).count();
}

void SkewMeter::add(const wire::ReleaseReport& report) {
    const auto span = std::ranges::find(spans_, report.frame, &Span::frame);
    if (span != spans_.end()) {
        span->earliestNs = std::min(span->earliestNs, report.atNs);
        span->latestNs = std::max(span->latestNs, report.atNs);
        ++span->nodes;
        return;
    }
    spans_.push_back({report.frame, report.atNs, report.atNs, 1});
    if (spans_.size() <= kOpen) return;
    const Span& closed = spans_.front();
    if (closed.nodes > 1) skews_.add(net::Instant{closed.latestNs - closed.earliestNs});
    spans_.pop_front();
}

}  // namespace aquarama::conductor
