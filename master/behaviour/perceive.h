// SPDX-License-Identifier: Apache-2.0
// Perception, the first stage of a thought: from all that a fish may look at to what it perceives.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <glm/vec3.hpp>

#include "common/base/units.h"
#include "master/behaviour/grids.h"
#include "master/behaviour/neighbours.h"
#include "master/fish/fish_view.h"
#include "master/fish/minds.h"
#include "master/fish/released.h"
#include "master/fish/secondary_controller.h"
#include "master/fish/wearers.h"
#include "master/surroundings/surroundings.h"

namespace aquarama::behaviour {

// All that a fish may read while it thinks. Points into the world; nothing in it changes meanwhile,
// so that fish may think in any order and on any thread.
struct Environment {
    const fish::FishView* view = nullptr;
    const Grids* grids = nullptr;
    const surroundings::Surroundings* surroundings = nullptr;
    // Parameters of species, by FishView::kind.
    std::span<const fish::SpeciesParameters> speciesParameters;
    config::Gathering gathering = config::Gathering::None;
    // Goal and radius of the school, where the scene has it gather.
    surroundings::Goal goal;
    float schoolRadiusMetres = 0;
    std::uint32_t seed = 0;
    Tick tick;
    fish::Adaptation adaptation;
    // Fish with visitors' drawings; null: none.
    const fish::Wearers* wearers = nullptr;
    // Those that are on their way; null: none is.
    const fish::ReleasedHunters* released = nullptr;
};

// Stimuli (Tu 1996, section 5.2): what the nearness of food or of a mate adds to a drive.
// Perception uses them too: what is too far away to change a decision is not searched for.

// The stimulus is s = 1 / d: it has no effect at the far distance and beyond, full effect at the
// near one. Distances to the nearest object, in body lengths of the fish that senses it.
struct StimulusRange {
    float farBodyLengths, nearBodyLengths;
};
inline constexpr StimulusRange kFoodStimulus{8, 2};
inline constexpr StimulusRange kMateStimulus{16, 4};
inline constexpr float kHungerStimulus = 0.8F;  // a_h
inline constexpr float kLibidoStimulus = 0.5F;  // a_l

// The effect S, 0 to 1: (s - q1) / (2 q2 - q1 - s) between q1 and q2. An infinite distance gives 0.
[[nodiscard]] constexpr float stimulusOf(const StimulusRange& range, float bodyLengths) {
    const float q1 = 1 / range.farBodyLengths;
    const float q2 = 1 / range.nearBodyLengths;
    const float s = 1 / bodyLengths;
    if (s < q1) return 0;
    if (s > q2) return 1;
    return (s - q1) / (2 * q2 - q1 - s);
}

// The distance, in body lengths, at which the effect is S > 0; 0 where no distance gives it.
[[nodiscard]] constexpr float bodyLengthsOf(const StimulusRange& range, float stimulus) {
    if (stimulus > 1) return 0;
    const float q1 = 1 / range.farBodyLengths;
    const float q2 = 1 / range.nearBodyLengths;
    return (1 + stimulus) / (q1 + stimulus * (2 * q2 - q1));
}

// The perception of one fish at one thought (Tu 1996, chapter 4; docs/minds.md). World frame,
// metres.

// An object that a fish perceives; nothing is seen by default.
struct Sighting {
    // A fish, or a particle of food.
    std::uint32_t object = fish::kNobody;
    // Offset from the origin of the body frame.
    glm::vec3 offset{};
    float distance = std::numeric_limits<float>::infinity();
    // For a predator: whether it pursues a fish, and whether it rushes at one.
    bool hunting = false;
    bool rushing = false;
    // For a predator: the share of the danger that is heeded, less of one that lies in wait or is
    // with a cleaner.
    float heeded = 1;
    // For a predator: its length, and whether its course passes this fish by.
    float length = 0;
    bool passesBy = false;
    [[nodiscard]] bool seen() const { return object != fish::kNobody; }
};
// Whether one object is nearer than another; of equally near ones the lower index is.
[[nodiscard]] constexpr bool isNearer(const Sighting& one, const Sighting& other) {
    return one.distance < other.distance ||
           (one.distance == other.distance && one.object < other.object);
}
// Another fish from a position, without asking whether something hides it.
[[nodiscard]] Sighting sightingOf(const fish::FishView& view,
                                  std::uint32_t other,
                                  glm::vec3 position);

// Number of predators that a fish keeps in mind; the nearest.
inline constexpr std::size_t kMostPredators = 4;

// Of the time of day.
struct HourSenses {
    // Whether it is outside the active hours of its species.
    bool rests = false;
    // Whether its species mates now (fish::matesAt()).
    bool mates = true;
};

// Of species that hide.
struct ShelterSenses {
    // The site that it dives into or rests in, or would, by index of the surroundings.
    Sighting site;
    // How many of its schoolmates near by dive.
    std::size_t diving = 0;
    // Of a fish that hides: whether it ventures out, where nothing threatens it.
    bool venturesOut = false;
};

// Of a territory (territory.h).
struct TerritorySenses {
    // Whether it holds one; the intruder that it charges or would.
    bool holds = false;
    Sighting intruder;
    // Who charges it.
    Sighting charger;
};

// Of cleaners and those that go to them (cleaning.h).
struct CleaningSenses {
    // Of a cleaner: the fish that it cleans or would.
    Sighting client;
    // Of one that goes to cleaners: how much it wants to, from 1 on it does; the cleaner, with the
    // offset to its station; how many others are there, and how many of them pose; whether the
    // cleaner is with it, and bites it.
    float urge = 0;
    Sighting cleaner;
    std::size_t clients = 0;
    std::size_t posing = 0;
    bool cleaned = false;
    bool bitten = false;
};

// Of light and warmth.
struct ClimateSenses {
    // Light where the fish is, 0 to 1.
    float light = 1;
    float celsius = 26;
    // How far light or temperature is outside what its habits like; 1 is all the light, or ten
    // degrees. Below 0 it is at ease.
    float discomfort = -1;
    // The direction in which its habits are met better: 1 up, -1 down, 0 nowhere in its water.
    float betterUp = 0;
};

// Made anew at every thought, on the stack.
struct Senses {
    // The fish itself.
    glm::vec3 position{};
    glm::vec3 heading{1, 0, 0};
    float speed = 0;   // metres a second
    float length = 0;  // metres

    // Nearest visible fish of its own species, and of others.
    Neighbours schoolmates;
    Neighbours others;
    // The fish with the largest share of its middle line in the sensitivity box, and that share.
    Sighting collision;
    float collisionShare = 0;
    // Nearest first; hidden ones are left out.
    std::array<Sighting, kMostPredators> predators;
    std::size_t predatorCount = 0;
    // Predators: the prey of least cost.
    Sighting prey;
    // Predators: how active their kind is now (surroundings::huntersActive()).
    float huntersActive = 0;
    // The willing mate of least cost (dearnessOfMate()).
    Sighting mate;
    // The particle of least cost, seen or smelt.
    Sighting food;
    HourSenses hour;
    ShelterSenses shelter;
    // Of those that graze: the patch of turf that it is at or goes to.
    Sighting patch;
    TerritorySenses territory;
    CleaningSenses cleaning;
    // Of a bold fish in a school: the structure that it makes for or stays at, by index.
    std::uint32_t structure = fish::kNobody;
    float submarineMetres = std::numeric_limits<float>::infinity();
    // Push of surroundings and submarine, and its length: 0 in open water; from 1 on only turning
    // away matters.
    glm::vec3 push{};
    float urgency = 0;
    // For a fish in the way of a moving submarine: how urgently it must get away, 0 to 1.
    float hurry = 0;
    ClimateSenses climate;
};

// All senses of one fish. `mind` says which target it pursues: it is kept unless another is better
// by the fish's persistence.
[[nodiscard]] Senses perceive(const Environment& environment,
                              const fish::SpeciesParameters& parameters,
                              std::uint32_t fish,
                              const fish::Mind& mind);

// Choice of a mate (Tu 1996, section 5.6.6): one of the same species and the other sex that is
// willing and about as long. A male prefers the nearer, a female the larger.

// The shorter of a pair is at least this share of the longer.
inline constexpr float kLeastSizeRatio = 0.7F;
// With inner libido below this, as after spawning, no mate in sight tempts.
inline constexpr float kTemptedFrom = 0.1F;

// Whether `other` suits `fish`, whose habits are `likes`, as a mate.
[[nodiscard]] bool suitsAsMate(const fish::FishView& view,
                               std::uint8_t likes,
                               std::uint32_t fish,
                               std::uint32_t other);

// Factor on the distance of a mate, 1 or more. A mate that courts another counts as farther; so
// does every other fish to one whose courtship is answered; and to a female a smaller male.
[[nodiscard]] float dearnessOfMate(const fish::FishView& view,
                                   std::uint8_t likes,
                                   std::uint32_t fish,
                                   std::uint32_t other);

}  // namespace aquarama::behaviour
