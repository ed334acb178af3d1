// SPDX-License-Identifier: Apache-2.0
// How fish move and live, species by species. It only reads the world, after a tick, on the thread
// of the world.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "common/base/units.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"
#include "master/world/world.h"

namespace aquarama::study {

// Sums over the fish of one species, or of a world.
struct SpeciesTally {
    // Radians of heading: turned by played segments, and added by the yaw of commands.
    double captured = 0, added = 0;
    // Commands that differ from the one before, and seconds summed over fish.
    std::uint64_t changes = 0;
    double fishSeconds = 0;
    // Particles or prey eaten, and times that fish began to flee and to court.
    std::uint64_t meals = 0, flights = 0, courtships = 0;
    std::uint64_t fastStarts = 0;
    // Angles between what a fish faces and its path over half a second, by whole degrees: of its
    // mean frame, which is what the motor adds to the captured motion, and of the body, averaged
    // over the same half second. Fish slower than kSlowestPath or backing are left out.
    std::array<std::uint64_t, 91> meanSlip{}, bodySlip{};

    // Share of the turning that was captured; 100 where there was none.
    [[nodiscard]] double capturedPercent() const {
        const double turned = captured + added;
        return turned > 0 ? 100 * captured / turned : 100;
    }
};

// The slowest path of which the slip is measured, body lengths a second.
inline constexpr float kSlowestPath = 0.2F;

// The least whole number of degrees that `share` of the angles do not exceed; 0 without any.
[[nodiscard]] int quantileDegrees(const std::array<std::uint64_t, 91>& slip, double share);

// Watches all fish of one world, tick by tick.
class SpeciesLog {
  public:
    // Begins with the world as it is.
    explicit SpeciesLog(const world::World& world);

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
        float addedYaw = 0;  // radians
        std::uint64_t command = 0;
        bool isNew = true;                    // just here: nothing to compare with
        glm::vec3 from{}, faces{}, bodies{};  // since the last glance: place, sums of directions
        fish::Intention intention{};
        std::uint16_t eaten = 0;
        std::uint32_t sinceMeal = 0;
        bool startles = false;
    };
    void noteFish(const world::World& world, std::size_t fish, bool glances);
    static void noteLife(const fish::Mind& mind, const Fish& fish, SpeciesTally& tally);
    static void noteSlip(const fish::VisibleFish& now, const Fish& fish, SpeciesTally& tally);

    std::vector<SpeciesTally> tallies_;
    std::vector<Fish> fish_;
    std::set<std::uint64_t> commands_;
};

}  // namespace aquarama::study
