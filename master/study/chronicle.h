// SPDX-License-Identifier: Apache-2.0
// Fish as straight round rods: whether two of them are in each other.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "common/units/units.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"
#include "master/world/world.h"

namespace aquarama::study {

// The body frame's origin is this share of the length behind the nose.
inline constexpr float kNoseAhead = 0.385F;

struct Rod {
    glm::vec3 origin{};          // of the body frame, metres
    glm::vec3 heading{1, 0, 0};  // unit vector
    float length = 0;            // metres
    float halfWidth = 0;         // metres, the greatest of the body
};

// Of all fish but those that are away, whose length is 0. Half-widths are given by kind, in body
// lengths.
void rodsOf(const fish::FishView& view, std::span<const float> halfWidths, std::vector<Rod>& rods);

// Between the middle lines from nose to tail, metres.
[[nodiscard]] float distanceBetween(const Rod& a, const Rod& b);

// Of the shorter one's middle line, the share that is nearer to the other's than their half-widths
// together; 0 where they do not overlap.
[[nodiscard]] float overlapOf(const Rod& a, const Rod& b);

// Who overlapped whom, how deep and for how long.

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

// What happened in a world while it was watched.

// Sums over the time watched.
struct Tally {
    double fishTicks = 0;
    std::uint64_t ticks = 0;

    std::uint64_t touches = 0;  // overlaps that began
    double overlapTicks = 0;    // fish of it
    std::uint64_t bumps = 0;    // into rock, sand or surface, that began
    double nearestNeighbour = 0, polarisation = 0, rotation = 0;  // of the school, at each glance
    double resultant = 0, sameSegment = 0, inStep = 0;            // likewise
    std::uint64_t glances = 0;

    std::array<double, fish::kIntentions> intentionTicks{};
    std::uint64_t changes = 0;  // of intention
    // By fish that eat what drifts: targets that they went for, and particles that they had.
    std::uint64_t tries = 0, particles = 0;
    // By predators.
    std::uint64_t rushes = 0, catches = 0;
};

class Diary {
  public:
    // Half-widths in body lengths, by kind. The school is the first kind.
    Diary(const world::World& world, std::vector<float> halfWidths);

    void note(const world::World& world);  // after each tick
    [[nodiscard]] const Tally& tally() const { return tally_; }
    [[nodiscard]] const OverlapLog& overlaps() const { return overlaps_; }

  private:
    void noteBodies(const world::World& world);
    void noteSchool(const world::World& world);
    void noteMind(const world::World& world, std::size_t fish);

    std::vector<float> halfWidths_;
    Tally tally_;
    OverlapLog overlaps_;
    std::vector<Rod> rods_;
    std::vector<std::uint8_t> bumps_;  // at the last glance
    // As they were at the last tick.
    std::vector<fish::Intention> intention_;
    std::vector<std::uint32_t> target_;
    std::vector<std::uint8_t> rushes_;
    world::WorldCounts before_;
};

// Whether the middle of its body is in rock, under the sand with its half-width, or in the air.
[[nodiscard]] bool isInTerrain(const surroundings::Obstacles& obstacles, const Rod& rod);

// A long life of a world, hour by hour: whether it stays as it should.

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
