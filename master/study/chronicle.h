// SPDX-License-Identifier: Apache-2.0
// Measuring a world from outside: overlaps of bodies, a diary of all that happens, and a chronicle
// hour by hour. Everything here only reads the world, after a tick, on the thread of the world.
// Bodies are taken as straight rods with round ends.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "common/base/units.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"
#include "master/world/world.h"

namespace aquarama::study {

// A body as a straight line with a half-width around it. A fish that is away has length 0.
struct Rod {
    // Of the body frame, metres.
    glm::vec3 origin{};
    glm::vec3 heading{1, 0, 0};  // unit vector
    float length = 0;            // metres
    // Half of the greatest width of the body, metres.
    float halfWidth = 0;
};

// Writes the rods of all fish; those of fish that are away get length 0. `halfWidths` are by kind,
// in body lengths.
void rodsOf(const fish::FishView& view, std::span<const float> halfWidths, std::vector<Rod>& rods);

// Distance between the middle lines from nose to tail, metres; sampled at 33 points of `a`.
[[nodiscard]] float distanceBetween(const Rod& a, const Rod& b);

// Share of the shorter body that is inside the other: of the points sampled along its middle line
// those nearer to the other middle line than both half-widths. 0 where they do not overlap.
[[nodiscard]] float overlapOf(const Rod& a, const Rod& b);

// Overlaps: which fish, how deep and for how long.

// One time for which two fish overlapped.
struct BodyOverlap {
    // The two fish, a < b.
    std::uint32_t a = 0, b = 0;
    // Their intentions when the overlap began.
    fish::Intention intentionOfA = fish::Intention::Wander, intentionOfB = fish::Intention::Wander;
    Tick from;
    // How long they overlapped at all.
    std::uint64_t ticks = 0;
    // Longest run with a share over kDeepShare.
    std::uint64_t deepTicks = 0;
    // Greatest share of the shorter body.
    float deepest = 0;
};

// An overlap over this share of the shorter body is a deep one.
inline constexpr float kDeepShare = 0.25F;

// Tracks overlaps from one glance to the next. A glance is O(fish^2). Overlaps shorter than the
// time between two glances may be missed.
class OverlapLog {
  public:
    explicit OverlapLog(std::uint64_t ticksBetweenGlances) : between_(ticksBetweenGlances) {}
    // Notes one glance and returns the overlaps that began at it, valid until the next call. Rods
    // and intentions are by fish.
    std::span<const BodyOverlap> note(Tick tick,
                                      std::span<const Rod> rods,
                                      std::span<const fish::Intention> intentions);

    // All overlaps, those that have ended first.
    [[nodiscard]] std::vector<BodyOverlap> all() const;
    // Ticks of overlap, summed over pairs.
    [[nodiscard]] std::uint64_t pairTicks() const { return pairTicks_; }

  private:
    // An overlap that still goes on.
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

// How fish move and live, species by species.

// Sums over the fish of one species, or of a world.
struct SpeciesTally {
    // Radians of heading: turned by played segments, and added by the yaw of commands.
    double captured = 0, added = 0;
    // Commands that differ from the one before, and seconds summed over fish.
    std::uint64_t changes = 0;
    double fishSeconds = 0;
    // Particles or prey eaten, and times that fish began to flee and to court.
    std::uint64_t meals = 0, flights = 0, courtships = 0;
    // Angles between what a fish faces and its path over half a second, by whole degrees: of its
    // mean frame, which is what the motor adds to the captured motion, and of the body, averaged
    // over the same half second. Fish slower than kSlowestPath or backing are left out.
    std::array<std::uint64_t, 91> meanSlip{}, bodySlip{};

    // Of what was turned; all of it where nothing was.
    [[nodiscard]] double capturedPercent() const {
        const double turned = captured + added;
        return turned > 0 ? 100 * captured / turned : 100;
    }
};
inline constexpr float kSlowestPath = 0.2F;  // body lengths a second
// The least whole number of degrees that `share` of the angles do not exceed; 0 without any.
[[nodiscard]] int quantileDegrees(const std::array<std::uint64_t, 91>& slip, double share);

// Watches all fish of one world, tick by tick.
class SpeciesLog {
  public:
    explicit SpeciesLog(const world::World& world);

    // Call it after every tick.
    void note(const world::World& world);
    // By species, in the order of the cast.
    [[nodiscard]] std::span<const SpeciesTally> byKind() const { return tallies_; }
    [[nodiscard]] SpeciesTally all() const;
    // Different commands that were given, of all species.
    [[nodiscard]] std::size_t distinctCommands() const { return commands_.size(); }

  private:
    // Of one fish: what it faced and was told in the tick before, and what is averaged for the
    // slip.
    struct Fish {
        glm::vec3 heading{};
        float addedYaw = 0;  // radians
        std::uint64_t command = 0;
        bool isNew = true;                    // just here: nothing to compare with
        glm::vec3 from{}, faces{}, bodies{};  // since the last glance: place, sums of directions
        fish::Intention intention{};
        std::uint16_t eaten = 0;
        std::uint32_t sinceMeal = 0;
    };
    void noteFish(const world::World& world, std::size_t fish, bool glances);
    static void noteLife(const fish::Mind& mind, const Fish& fish, SpeciesTally& tally);
    static void noteSlip(const fish::VisibleFish& now, const Fish& fish, SpeciesTally& tally);

    std::vector<SpeciesTally> tallies_;
    std::vector<Fish> fish_;
    std::set<std::uint64_t> commands_;
};

// A diary: what happened in a world while it was watched.

// Sums over the time watched. Means and rates are formed by figuresOf().
struct Tally {
    // Ticks summed over the fish that were there, and ticks of the world.
    double fishTicks = 0;
    std::uint64_t ticks = 0;

    // Overlaps that began.
    std::uint64_t touches = 0;
    // Ticks of overlap, summed over fish: each pair counts twice.
    double overlapTicks = 0;
    // Times that a fish got into rock, sand or surface.
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

// Whether the origin of the body is inside a rock, less than its half-width over the sand, or at
// the surface. A fish that is away is not.
[[nodiscard]] bool isInTerrain(const surroundings::Obstacles& obstacles, const Rod& rod);

// A chronicle: a long life of a world, hour by hour.

// Figures of one piece of a chronicle, an hour or what the caller takes for one. The last piece may
// be shorter.
struct Hour {
    std::uint64_t ticks = 0;
    // What happened in it.
    world::WorldCounts counts;
    // Smallest number of fish that were there at once.
    std::uint32_t fewest = 0;
    // Share of the time of all fish, by intention.
    std::array<double, fish::kIntentions> intentionShare{};
    // Changes of intention, for each fish and minute.
    double changes = 0;
    // Overlaps that began, for each fish and minute.
    double touches = 0;
    // Of the time of a fish.
    double overlapPercent = 0;
    // Times that a fish got into rock, sand or surface.
    std::uint64_t bumps = 0;

    // Way of the fish that swam least.
    float shortestWayMetres = 0;
    // Longest time that a fish stayed within kStayMetres, and which fish.
    double longestStaySeconds = 0;
    std::uint32_t whoStayed = 0;
    // Farthest that a fish was outside the water; negative while all were inside.
    float farthestOutMetres = 0;
    // Root mean square distance of all fish from their middle.
    float spreadMetres = 0;
    // Share of the cubic metres of the water that some fish was in.
    double waterUsedPercent = 0;
};
inline constexpr float kStayMetres = 0.1F;

// Watches one world and cuts its life into hours. Its memory grows with hours and overlaps only.
class Chronicle {
  public:
    // `halfWidths` are in body lengths, one for each kind.
    Chronicle(const world::World& world, std::vector<float> halfWidths, std::uint64_t ticksOfHour);

    // Call it after every tick.
    void note(const world::World& world);
    // All hours that are complete, and the present one if it is more than half over.
    [[nodiscard]] std::vector<Hour> hours() const;
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
