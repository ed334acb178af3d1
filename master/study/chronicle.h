// SPDX-License-Identifier: Apache-2.0
// A long life of a world, hour by hour: whether it stays as it should.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "master/study/diary.h"
#include "master/world/world.h"

namespace aquarama::study {

// A piece of it; the last one may be shorter.
struct Hour {
    std::uint64_t ticks = 0;
    world::WorldCounts counts;  // what happened in it
    std::uint32_t fewest = 0;   // fish that were there at once
    std::array<double, fish::kIntentions> intentionShare{};
    double changes = 0;         // of intention, a fish and minute
    double touches = 0;         // overlaps that began, a fish and minute
    double overlapPercent = 0;  // of the time of a fish
    std::uint64_t bumps = 0;    // into rock, sand or surface

    float shortestWayMetres = 0;    // of the fish that swam least
    double longestStaySeconds = 0;  // of a fish within kStayMetres of where it was
    std::uint32_t whoStayed = 0;
    float farthestOutMetres = 0;  // of the water; negative while all are inside
    float spreadMetres = 0;       // root mean square distance of all fish from their middle
    double waterUsedPercent = 0;  // of its cubic metres, those that some fish was in
};
inline constexpr float kStayMetres = 0.1F;

class Chronicle {
  public:
    // Half-widths in body lengths, by kind.
    Chronicle(const world::World& world, std::vector<float> halfWidths, std::uint64_t ticksOfHour);

    void note(const world::World& world);  // after each tick
    // With the hour under way, unless it has only begun.
    [[nodiscard]] std::vector<Hour> hours() const;
    [[nodiscard]] const OverlapLog& overlaps() const { return diary_.overlaps(); }

  private:
    struct Way {  // of a fish
        glm::vec3 last{}, anchor{};
        std::uint64_t anchoredAt = 0;
        double metres = 0;
    };
    void noteWay(const world::World& world, std::size_t fish);
    void notePlaces(const world::World& world);
    void beginHour(const world::World& world);
    [[nodiscard]] Hour finished(const Hour& hour) const;

    Diary diary_;
    std::uint64_t ticksOfHour_;
    std::vector<Hour> done_;
    Hour now_;
    Tally before_;  // as the hour began
    world::WorldCounts countsBefore_;
    world::WorldCounts counts_;
    std::vector<Way> ways_;
    std::vector<std::uint8_t> visited_;  // of the cubic metres of the water
    double squares_ = 0, samples_ = 0;   // of distances from the middle
};

}  // namespace aquarama::study
