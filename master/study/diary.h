// SPDX-License-Identifier: Apache-2.0
// What happened in a world while it was watched.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "master/study/bodies.h"
#include "master/study/overlap_log.h"
#include "master/world/world.h"

namespace aquarama::study {

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

}  // namespace aquarama::study
