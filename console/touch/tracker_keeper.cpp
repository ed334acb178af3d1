// SPDX-License-Identifier: Apache-2.0
#include "console/touch/tracker_keeper.h"

#include <chrono>
#include <utility>

#include "common/base/log.h"
#include "console/cues/listen.h"
#include "console/touch/port_loan.h"

namespace aquarama::console {

void TrackerKeeper::everySecond() {
    lend();
    if (tracker_ || isLent_ || !rig_.touch) return;
    listenTo("hands by TUIO", rig_.touch->listen, problem_, [this] { tracker_.emplace(rig_); });
}

void TrackerKeeper::lend() {
    const bool wasLent = std::exchange(isLent_, PortLoan::isAsked(rigFile_));
    if (wasLent == isLent_) return;
    if (isLent_) {
        tracker_.reset();
        problem_.clear();
        return logInfo("the tracker's port is lent to aquarama touch");
    }
    try {
        rig_.touch = config::readRig(rigFile_).touch;
    } catch (const Error& problem) {
        logWarning("the corners of touch stay as they were: {}", problem.what());
    }
}

std::optional<WallHands> TrackerKeeper::tick() {
    using std::chrono::steady_clock;
    if (!tracker_) return std::nullopt;
    const std::chrono::duration<double> now = steady_clock::now().time_since_epoch();
    return tracker_->tick(now.count());
}

}  // namespace aquarama::console
