// SPDX-License-Identifier: Apache-2.0
// The fish at the last few ticks: a frame shows a moment between two of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <utility>
#include <vector>

#include "common/base/units.h"
#include "common/motion/motion_state.h"
#include "common/school/school_state.h"

namespace aquarama::session {

// Used by the net thread.
class RecentFish {
  public:
    // Forgets them.
    void clear() { ticks_.clear(); }
    // The fish of the next tick. The buffers of the oldest are used again.
    void remember(const school::SchoolState& school) {
        AtTick newest;
        if (ticks_.size() == kTicks) {
            newest = std::move(ticks_.front());
            ticks_.pop_front();
        }
        newest.tick = school.tick;
        school.records(newest.fish);
        ticks_.push_back(std::move(newest));
    }
    // Null: it is none of the last.
    [[nodiscard]] const std::vector<motion::FishRecord>* at(Tick tick) const {
        const auto found = std::ranges::find(ticks_, tick, &AtTick::tick);
        return found == ticks_.end() ? nullptr : &found->fish;
    }
    // There is one.
    [[nodiscard]] const std::vector<motion::FishRecord>& newest() const {
        return ticks_.back().fish;
    }
    [[nodiscard]] Tick oldestTick() const { return ticks_.front().tick; }

  private:
    struct AtTick {
        Tick tick;
        std::vector<motion::FishRecord> fish;
    };
    // The master sends its last two frames again where one was lost; each shows up to two ticks.
    static constexpr std::size_t kTicks = 4;
    std::deque<AtTick> ticks_;  // the newest last
};

}  // namespace aquarama::session
