// SPDX-License-Identifier: Apache-2.0
#include "master/study/overlap_log.h"

#include <algorithm>

namespace aquarama::study {

std::span<const BodyOverlap> OverlapLog::note(Tick tick,
                                              std::span<const Rod> rods,
                                              std::span<const fish::Intention> intentions) {
    fresh_.clear();
    for (std::uint32_t a = 0; a < rods.size(); ++a)
        for (std::uint32_t b = a + 1; b < rods.size(); ++b)
            if (const float share = overlapOf(rods[a], rods[b]); share > 0)
                meet({.a = a,
                      .b = b,
                      .intentionOfA = intentions[a],
                      .intentionOfB = intentions[b],
                      .from = tick},
                     share);
    std::erase_if(open_, [&](const auto& entry) {
        if (entry.second.last.value == tick.value) return false;
        ended_.push_back(entry.second.overlap);
        return true;
    });
    return fresh_;
}

void OverlapLog::meet(const BodyOverlap& overlap, float share) {
    const auto [entry, isNew] =
        open_.try_emplace({overlap.a, overlap.b}, Open{overlap, 0, overlap.from});
    if (isNew) fresh_.push_back(overlap);
    Open& open = entry->second;
    open.last = overlap.from;
    open.overlap.ticks += between_;
    open.overlap.deepest = std::max(open.overlap.deepest, share);
    open.deepRun = share > kDeepShare ? open.deepRun + between_ : 0;
    open.overlap.deepTicks = std::max(open.overlap.deepTicks, open.deepRun);
    pairTicks_ += between_;
}

std::vector<BodyOverlap> OverlapLog::all() const {
    std::vector<BodyOverlap> all = ended_;
    for (const auto& [pair, open] : open_) all.push_back(open.overlap);
    return all;
}

}  // namespace aquarama::study
