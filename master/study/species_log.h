// SPDX-License-Identifier: Apache-2.0
// How fish move and live, species by species. It only reads the world, after a tick, on the thread
// of the world.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <set>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "common/base/units.h"
#include "common/motion/motor_tables.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"
#include "master/world/world.h"

namespace aquarama::study {

// How much of a motion was captured.
struct Share {
    double captured = 0, added = 0;
    // 100 where there was no motion.
    [[nodiscard]] double percent() const {
        const double all = captured + added;
        return all > 0 ? 100 * captured / all : 100;
    }
    void add(double turned, double addedToIt) {
        captured += std::abs(turned - addedToIt);
        added += std::abs(addedToIt);
    }
    void add(const Share& other) {
        captured += other.captured;
        added += other.added;
    }
};

// Sums over the fish of one species, or of a world.
struct SpeciesTally {
    // What played segments did, and what was added to it: heading by the yaw of commands, radians;
    // pitch by steering, radians; way by a speed other than the segment's, body lengths.
    Share heading, pitch, way;
    // Commands that differ from the one before, and seconds summed over fish.
    std::uint64_t changes = 0;
    double fishSeconds = 0;
    // Particles, prey or what counts as a particle of turf eaten, and times that fish began to
    // flee, to hide and to court.
    std::uint64_t meals = 0, flights = 0, dives = 0, courtships = 0;
    std::uint64_t spawnings = 0;
    std::uint64_t fastStarts = 0;
    // Angles between what a fish faces and its path through the water over half a second, by whole
    // degrees: of its mean frame, which is what the motor adds to the captured motion, and of the
    // body, averaged over the same half second. Fish slower than kSlowestPath or backing are left
    // out.
    std::array<std::uint64_t, 91> meanSlip{}, bodySlip{};
};

// The slowest path of which the slip is measured, body lengths a second.
inline constexpr float kSlowestPath = 0.2F;

// The least whole number of degrees that `share` of the angles do not exceed; 0 without any.
[[nodiscard]] int quantileDegrees(const std::array<std::uint64_t, 91>& slip, double share);

// Watches all fish of one world, tick by tick.
class SpeciesLog {
  public:
    // Begins with the world as it is, of that cast.
    SpeciesLog(const world::World& world, std::span<const world::WorldSpecies> cast);

    // Call it after every tick.
    void note(const world::World& world);
    // The sums by species, in the order of the cast.
    [[nodiscard]] std::span<const SpeciesTally> byKind() const { return tallies_; }
    // The sum of all species.
    [[nodiscard]] SpeciesTally all() const;
    // Different commands that were given, of all species.
    [[nodiscard]] std::size_t distinctCommands() const { return commands_.size(); }

  private:
    // The state of one fish: its heading and command in the tick before, and the sums for the slip.
    struct Fish {
        glm::vec3 heading{};
        float addedYaw = 0, addedPitch = 0;  // radians
        std::uint64_t command = 0;
        bool isNew = true;                    // just here: nothing to compare with
        glm::vec3 from{}, faces{}, bodies{};  // since the last glance: place, sums of directions
        fish::Intention intention{}, aim{};
        std::uint16_t eaten = 0;
        std::uint32_t sinceMeal = 0, sinceSpawning = 0;
        bool startles = false;
    };
    void noteFish(const world::World& world, std::size_t fish, bool glances);
    void noteSpawnings(const world::World& world);
    [[nodiscard]] bool spawned(const world::World& world, std::size_t fish) const;
    static void noteLife(const fish::Mind& mind, const Fish& fish, SpeciesTally& tally);
    static void noteSlip(const fish::VisibleFish& now, const Fish& fish, SpeciesTally& tally);

    void noteWay(const world::World& world, std::size_t fish, SpeciesTally& tally) const;
    // What steering adds to the pitch of a fish in this tick, radians.
    [[nodiscard]] float addedPitch(const world::World& world, std::size_t fish) const;
    [[nodiscard]] const motion::MotorTables& tablesOf(const world::World& world,
                                                      std::size_t fish) const {
        return *tables_[world.view().kind[fish]];
    }

    std::vector<std::shared_ptr<const motion::MotorTables>> tables_;  // by kind
    std::vector<SpeciesTally> tallies_;
    std::vector<Fish> fish_;
    std::uint64_t spawnings_;  // of the world, so far
    std::set<std::uint64_t> commands_;
};

}  // namespace aquarama::study
