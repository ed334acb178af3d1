// SPDX-License-Identifier: Apache-2.0
#include "master/standby/followed_clock.h"

#include <algorithm>
#include <chrono>

#include "master/conductor/simulation_thread.h"

namespace aquarama::standby {

using conductor::kTickPeriod;

void FollowedClock::add(Tick tick, net::Moment came) {
    constexpr net::Duration kKept = std::chrono::seconds(2);
    const auto since = static_cast<net::Duration::rep>(tick.value) * kTickPeriod;
    beginnings_.push_back({came, came - since});
    while (came - beginnings_.front().came > kKept) beginnings_.pop_front();
}

std::optional<Tick> FollowedClock::tickAt(net::Moment now) const {
    if (beginnings_.empty()) return std::nullopt;
    const net::Moment at = std::ranges::min(beginnings_, {}, &Beginning::at).at;
    return Tick{static_cast<std::uint64_t>((now - at) / kTickPeriod)};
}

}  // namespace aquarama::standby
