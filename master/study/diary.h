// SPDX-License-Identifier: Apache-2.0
// A diary: what happened in a world while it was watched. It only reads the world, after a tick, on
// the thread of the world.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "master/fish/minds.h"
#include "master/study/overlaps.h"
#include "master/surroundings/surroundings.h"
#include "master/world/world.h"

namespace aquarama::study {

// Sums over the time watched. Means and rates are formed by figuresOf().
struct Tally {
    // Ticks summed over the fish that were there, and ticks of the world.
    double fishTicks = 0;
    std::uint64_t ticks = 0;

    // Overlaps that began.
    std::uint64_t touches = 0;
    // Ticks of overlap, summed over fish: each pair counts twice.
    double overlapTicks = 0;
    // Times that a fish that was not in its shelter got into rock, sand or surface.
    std::uint64_t bumps = 0;
    // Sums of SchoolFigures and Synchrony of the school over all glances.
    double nearestNeighbour = 0, polarisation = 0, rotation = 0;
    double resultant = 0, sameSegment = 0, inStep = 0;
    std::uint64_t glances = 0;

    // Ticks of each intention, summed over fish.
    std::array<double, fish::kIntentions> intentionTicks{};
    // Changes of intention.
    std::uint64_t changes = 0;
    // Fish that eat particles: targets that they pursued, and particles that they got.
    std::uint64_t tries = 0, particles = 0;
    // The same fish: ticks in which they pursued a particle.
    std::uint64_t pursuitTicks = 0;
    // Predators: rushes that began, and prey that they got.
    std::uint64_t rushes = 0, catches = 0;
};

// Watches one world. Minds are noted after every tick; bodies and school at a glance every five
// ticks.
class Diary {
  public:
    // `halfWidths` are in body lengths, one for each kind. The school is the first kind.
    Diary(const world::World& world, std::vector<float> halfWidths);

    // Call it after every tick.
    void note(const world::World& world);
    // The sums, and the overlaps of bodies, since it began.
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
    // By fish: whether it was in terrain at the last glance.
    std::vector<std::uint8_t> bumps_;
    // By fish, as they were after the last tick.
    std::vector<fish::Intention> intention_;
    std::vector<std::uint32_t> target_;
    std::vector<std::uint8_t> rushes_;
    world::WorldCounts before_;
};

// Whether the origin of the body is inside a rock as it is drawn, less than its half-width over the
// sand, or at the surface. A fish that is away is not.
[[nodiscard]] bool isInTerrain(const place::Obstacles& obstacles, const Rod& rod);

}  // namespace aquarama::study
