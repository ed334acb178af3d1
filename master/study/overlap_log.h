// SPDX-License-Identifier: Apache-2.0
// Who overlapped whom, how deep and for how long.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "common/units/ids.h"
#include "master/fish/minds.h"
#include "master/study/bodies.h"

namespace aquarama::study {

struct BodyOverlap {
    std::uint32_t a = 0, b = 0;  // fish, a < b
    fish::Intention intentionOfA = fish::Intention::Wander,
                    intentionOfB = fish::Intention::Wander;  // as it began
    Tick from;
    std::uint64_t ticks = 0;      // in which any of them was in the other
    std::uint64_t deepTicks = 0;  // in which more than kDeepShare was, the longest run of them
    float deepest = 0;            // share of the shorter body
};

inline constexpr float kDeepShare = 0.25F;

// Looks every few ticks; what is shorter than that may be missed.
class OverlapLog {
  public:
    explicit OverlapLog(std::uint64_t ticksBetweenGlances) : between_(ticksBetweenGlances) {}
    // Answers the overlaps that are new.
    std::span<const BodyOverlap> note(Tick tick,
                                      std::span<const Rod> rods,
                                      std::span<const fish::Intention> intentions);

    [[nodiscard]] std::vector<BodyOverlap> all() const;  // those that go on as well
    [[nodiscard]] std::uint64_t pairTicks() const { return pairTicks_; }

  private:
    struct Open {
        BodyOverlap overlap;
        std::uint64_t deepRun = 0;
        Tick last;
    };
    void meet(const BodyOverlap& overlap, float share);

    std::uint64_t between_;
    std::uint64_t pairTicks_ = 0;
    std::map<std::pair<std::uint32_t, std::uint32_t>, Open> open_;
    std::vector<BodyOverlap> ended_;
    std::vector<BodyOverlap> fresh_;
};

}  // namespace aquarama::study
