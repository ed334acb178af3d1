// SPDX-License-Identifier: Apache-2.0
// The knowledge of fish about one another: the parameters of a species, and the view of all fish at
// the start of a tick. World frame, metres.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "common/base/digest.h"
#include "common/base/units.h"
#include "common/config/species.h"

namespace aquarama::fish {

// A species as the minds of its fish use it. Made once per world by world::makeSpeciesParameters();
// read by all threads. Sets of kinds are bit masks: bit i stands for species i of the cast.
struct SpeciesParameters {
    // Index of the species in the cast.
    std::uint8_t kind = 0;
    // Its fish have the indices [first, last).
    std::uint32_t first = 0, last = 0;
    // The kinds that it eats, that eat it, and that it likes to follow.
    std::uint64_t hunts = 0;
    std::uint64_t huntedBy = 0;
    std::uint64_t shadows = 0;
    // The kinds that it charges in its territory, and those that charge it.
    std::uint64_t expels = 0;
    std::uint64_t expelledBy = 0;
    // Lengths of its fish, metres.
    config::SizeRange size = {};
    // Homes of its groups, metres, in the order of the fish; as many fish share one. Without
    // elements where the species keeps to no place.
    std::vector<glm::vec3> homes = {};
    std::uint32_t fishAtAHome = 2;
    // Speeds of the three forward gaits of its repertoire, in body lengths a second.
    float slow = 1, medium = 2, fast = 3;
    // Seconds in which sharp turns add up to a right angle.
    float turnSeconds = 1;
    config::Habits habits;
};
// Whether the species flees: prey, and whatever is hunted by another species of the cast.
[[nodiscard]] inline bool flees(const SpeciesParameters& parameters) {
    return parameters.habits.role == config::Role::Prey || parameters.huntedBy != 0;
}

// Whether its fish patrol: hunters without a home that do not lie in wait.
[[nodiscard]] inline bool patrols(const SpeciesParameters& parameters) {
    const config::Habits& habits = parameters.habits;
    return habits.role == config::Role::Predator && habits.home.kind == config::HomeKind::None &&
           !habits.hunt.ambush && parameters.hunts != 0;
}

// Fish [first, last) that share a home; all of a species that keeps to no place.
struct Household {
    std::uint32_t first, last;
    // Whether a fish, by its index, belongs to it.
    [[nodiscard]] bool holds(std::uint32_t fish) const { return fish >= first && fish < last; }
};
// The household of a fish of this species.
[[nodiscard]] inline Household householdOf(const SpeciesParameters& parameters,
                                           std::uint32_t fish) {
    if (parameters.homes.empty()) return {parameters.first, parameters.last};
    const std::uint32_t own = (fish - parameters.first) / parameters.fishAtAHome;
    const std::uint32_t first = parameters.first + own * parameters.fishAtAHome;
    return {first, std::min(parameters.last, first + parameters.fishAtAHome)};
}

// The visible data of a fish at the start of a tick. The world writes it before the fish think;
// while they think it is constant, so that all threads may read it.

// Index that stands for no fish, or no particle of food.
inline constexpr std::uint32_t kNobody = 0xffffffffU;

// Signs of a fish's mood that others can see, as bits of FishView::signs.
enum MoodSign : std::uint8_t {
    // Eaten, or not yet come: nobody sees it.
    kAway = 1,
    // Would mate.
    kWilling = 2,
    kFemale = 4,
    kHunting = 8,
    kSchooling = 16,  // swims in a school
    kStartled = 32,   // makes a fast start
    kAlarmed = 64,    // heeds its fear
    kDiving = 128,    // dives into its shelter
};

// Position and motion of one fish. It is 32 bytes long and aligned, so that all of it lies in one
// cache line.
struct alignas(32) VisibleFish {
    // Origin of the body frame, metres.
    glm::vec3 position{};
    // Mean direction of swimming, a unit vector, without the sway of the tail beat.
    glm::vec3 heading{};
    float speed = 0;   // metres a second
    float length = 0;  // metres
};

// Columns with one element for each fish of the world, away or not, in the order of the cast.
struct FishView {
    std::vector<VisibleFish> fish;
    // Species, as an index into the cast.
    std::vector<std::uint8_t> kind;
    // Bits of MoodSign.
    std::vector<std::uint8_t> signs;
    // The fish that it courts or cleans, or the cleaner that it visits; or kNobody.
    std::vector<std::uint32_t> partner;
    // Mind::stage: the stage of its courtship, cleaning or hunt.
    std::vector<std::uint8_t> stage;
    // The patch of turf that it grazes at or goes to, by index, or kNobody.
    std::vector<std::uint32_t> patch;
    // The fish that it charges, or kNobody.
    std::vector<std::uint32_t> charged;

    // Fish that are added have no partner and no signs.
    void resize(std::size_t count) {
        fish.resize(count);
        kind.resize(count);
        signs.resize(count);
        partner.resize(count, kNobody);
        stage.resize(count);
        patch.resize(count, kNobody);
        charged.resize(count, kNobody);
    }
    // Memory in use.
    [[nodiscard]] std::size_t bytes() const {
        return bytesIn(fish, kind, signs, partner, stage, patch, charged);
    }
    [[nodiscard]] std::size_t size() const { return fish.size(); }
    [[nodiscard]] glm::vec3 position(std::size_t i) const { return fish[i].position; }
    [[nodiscard]] glm::vec3 heading(std::size_t i) const { return fish[i].heading; }
    // Prefetches a fish that will be read soon.
    void fetch(std::size_t i) const { __builtin_prefetch(&fish[i]); }
    [[nodiscard]] bool shows(std::size_t i, MoodSign sign) const { return (signs[i] & sign) != 0; }
};

// Distance from the origin of the body frame forward to the nose, where the mouth is, in body
// lengths: nodal point 0 of every rest shape. Minds take the mouth there, without the sway of the
// head.
inline constexpr float kNoseBodyLengths = 0.385F;

}  // namespace aquarama::fish
