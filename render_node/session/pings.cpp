// SPDX-License-Identifier: Apache-2.0
#include "render_node/session/pings.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>

namespace aquarama::session {
namespace {

constexpr net::Duration kPatience = std::chrono::seconds(1);  // before a ping counts as unanswered
constexpr std::size_t kKept = 200;                            // of ten seconds

}  // namespace

std::optional<v1::Envelope> Pings::due(net::Moment now) {
    if (now - last_ < kInterval) return std::nullopt;
    v1::Envelope message;
    message.mutable_ping()->set_sent_ns(now.time_since_epoch().count());
    last_ = now;
    sent_.emplace_back(now, std::nullopt);
    if (sent_.size() > kKept) sent_.pop_front();
    return message;
}

void Pings::hear(const v1::Pong& pong, net::Moment now) {
    const net::Moment sent{net::Duration{pong.sent_ns()}};
    clock_.add(sent, net::Moment{net::Duration{pong.master_ns()}}, now);
    const auto ping = std::ranges::find(sent_, sent, [](const auto& p) { return p.first; });
    if (ping != sent_.end()) ping->second = now - sent;
}

void Pings::report(v1::NodeReport& report, net::Moment now) const {
    net::RecentTimes roundTrips;
    std::size_t unanswered = 0;
    std::optional<net::Duration> before;
    double jitter = 0;
    int answered = 0;
    for (const auto& [sent, roundTrip] : sent_) {
        if (!roundTrip && now - sent > kPatience) ++unanswered;
        if (!roundTrip) continue;
        roundTrips.add(*roundTrip);
        if (before) jitter += std::abs(net::secondsIn(*roundTrip - *before));
        before = roundTrip;
        ++answered;
    }
    report.set_round_trip_median_ms(roundTrips.quantileMs(0.5));
    report.set_round_trip_p99_ms(roundTrips.quantileMs(0.99));
    report.set_jitter_ms(static_cast<float>(1000 * jitter / std::max(answered - 1, 1)));
    report.set_unanswered_percent(100 * static_cast<float>(unanswered) /
                                  static_cast<float>(std::max<std::size_t>(sent_.size(), 1)));
    report.set_clock_drift_ppm(static_cast<float>(clock_.driftPpm()));
}

}  // namespace aquarama::session
