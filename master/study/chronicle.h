// SPDX-License-Identifier: Apache-2.0
// A chronicle: a long life of a world, hour by hour. It only reads the world, after a tick, on the
// thread of the world.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "master/fish/minds.h"
#include "master/study/diary.h"
#include "master/study/overlaps.h"
#include "master/study/species_log.h"
#include "master/world/world.h"

namespace aquarama::study {

// Figures of one piece of a chronicle, an hour or what the caller takes for one. The last piece may
// be shorter.
struct Hour {
    std::uint64_t ticks = 0;
    // Counters of what happened in it.
    world::WorldCounts counts;
    // Smallest number of fish that were there at once.
    std::uint32_t fewest = 0;
    // Share of the time of all fish, by intention.
    std::array<double, fish::kIntentions> intentionShare{};
    // Changes of intention, for each fish and minute.
    double changes = 0;
    // Overlaps that began, for each fish and minute.
    double touches = 0;
    // Share of a fish's time in overlaps.
    double overlapPercent = 0;
    // Times that a fish that was not in its shelter got into rock, sand or surface.
    std::uint64_t bumps = 0;

    // Way of the fish that swam least.
    float shortestWayMetres = 0;
    // Longest time that a fish stayed within kStayMetres without resting, and which fish.
    double longestStaySeconds = 0;
    std::uint32_t whoStayed = 0;
    // Farthest that a fish was outside the water; negative while all were inside.
    float farthestOutMetres = 0;
    // Root mean square distance of all fish from their middle.
    float spreadMetres = 0;
    // Share of the cubic metres of the water that some fish was in.
    double waterUsedPercent = 0;
};

// A fish stays in a place while it is within this distance of it.
inline constexpr float kStayMetres = 0.1F;

// Watches one world and cuts its life into hours. Its memory grows with hours and overlaps only.
class Chronicle {
  public:
    // `halfWidths` are in body lengths, one for each kind.
    Chronicle(const world::World& world,
              std::vector<float> halfWidths,
              std::span<const world::WorldSpecies> cast,
              std::uint64_t ticksOfHour);

    // Call it after every tick.
    void note(const world::World& world);
    // All hours that are complete, and the present one if it is more than half over.
    [[nodiscard]] std::vector<Hour> hours() const;
    // The noted overlaps and species.
    [[nodiscard]] const OverlapLog& overlaps() const { return diary_.overlaps(); }
    [[nodiscard]] const SpeciesLog& species() const { return species_; }

  private:
    // Way of one fish in this hour, and the place where it last left the radius of a stay.
    struct Way {
        glm::vec3 last{}, anchor{};
        std::uint64_t anchoredAt = 0;
        double metres = 0;
    };
    void noteWay(const world::World& world, std::size_t fish);
    void notePlaces(const world::World& world);
    void beginHour(const world::World& world);
    [[nodiscard]] Hour finished(const Hour& hour) const;

    Diary diary_;
    SpeciesLog species_;
    std::uint64_t ticksOfHour_;
    std::vector<Hour> done_;
    Hour now_;
    // Sums when the present hour began.
    Tally before_;
    world::WorldCounts countsBefore_;
    world::WorldCounts counts_;
    std::vector<Way> ways_;
    // For each cubic metre of the water: whether some fish was in it.
    std::vector<std::uint8_t> visited_;
    // Sum and number of squared distances from the middle of all fish.
    double squares_ = 0, samples_ = 0;
};

}  // namespace aquarama::study
