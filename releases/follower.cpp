// SPDX-License-Identifier: Apache-2.0
#include "releases/follower.h"

#include <algorithm>
#include <utility>

namespace aquarama::releases {

ReleaseFollower::ReleaseFollower(FollowerMemory memory, ReleaseId booted, std::string boot)
    : memory_{std::move(memory)}, booted_{std::move(booted)}, boot_{std::move(boot)} {}

std::uint64_t ReleaseFollower::leftIn() const {
    const bool isLeft = boot_ != memory_.triedFrom && booted_ != memory_.tried;
    return isLeft ? memory_.triedIn : 0;
}

bool ReleaseFollower::mayShow(double now) const {
    return memory_.settled == booted_ || now < shownUntil_;
}

FollowerDuties ReleaseFollower::obey(const MachineOrder& order,
                                     const std::vector<ReleaseId>& held,
                                     double reportedAt,
                                     double leaseSeconds) {
    epoch_ = order.epoch;
    if (!order.run) return {};
    const bool isHere = order.run == booted_;
    FollowerDuties duties{.isBlessed = isHere && order.isSettled, .fetch = order.fetch};
    memory_.settled = duties.isBlessed ? booted_ : ReleaseId{};
    shownUntil_ = isHere && order.mayShow ? reportedAt + leaseSeconds : 0;
    duties.isDark = !duties.isBlessed && shownUntil_ == 0;
    if (!isHere && std::ranges::find(held, order.run) != held.end()) {
        duties.start = order.run;
        remember(order);
    }
    return duties;
}

void ReleaseFollower::remember(const MachineOrder& order) {
    memory_.triedIn = order.epoch;
    memory_.tried = order.run;
    memory_.triedFrom = boot_;
}

}  // namespace aquarama::releases
