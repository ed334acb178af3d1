// SPDX-License-Identifier: Apache-2.0
// The register of random streams: what is drawn from a world's seed. Two draws that must be
// independent have two streams. The number of a stream never changes and is never used again, as
// the world of every seed depends on it.
#pragma once

#include <cstdint>

#include "common/base/hash.h"

namespace aquarama {

// Groups of streams begin at round numbers, so that a group can grow.
enum class Stream : std::uint32_t {
    // The place.
    Dunes = 1,
    Hummocks,
    Rocks,
    Kelp,
    Meadow,
    Arch,
    Ring,
    Heads,
    Sites,
    // The secondary controller of the motor.
    Tempo = 101,
    Patience,
    RecommendedGait,
    GaitHold,
    // Where and how fish begin.
    BeginningLength = 201,
    BeginningPlace,
    BeginningPhase,
    BeginningHeading,
    // Homes.
    HomePlaces = 301,
    Homes,
    Beats,
    // Wandering.
    Pace = 311,
    WanderTurn,
    TurnSharpness,
    // Companions.
    Bouts = 321,
    Hosts,
    // The school.
    SchoolLevels = 341,
    Glances,
    Bold,
    Ways,
    Liking,
    // Life at the reef.
    VenturesOut = 361,
    Picks,
    CloudPlaces,
    Spots,
    Patches,
    Loops,
    Bites,
    Sand,
    GrazingPeriods,
    Owners,
    HoursOfRest,
    RestingPlaces,
    Curiosity,
    // Cleaners and ambushes.
    Cleaning = 381,
    Urge,
    Pose,
    Posts,
    // Food.
    FoodPlace = 401,
    FoodAbsence,
    FoodSpread,
    // Temperament.
    LikesBrightness = 501,
    LikesDarkness,
    LikesWarmth,
    LikesCold,
    LikesSchooling,
    SinceMeal = 507,
    SinceSpawning,
    SinceCleaning,
    // Who was eaten.
    Absence = 601,
    Arrival,
};

// The seed of a stream in the world of `seed`.
[[nodiscard]] constexpr std::uint32_t hashOf(std::uint32_t seed, Stream stream) {
    return hashOf(seed, static_cast<std::uint32_t>(stream));
}
// The number that a thing, such as a fish by its index, has of a stream. Hashed with a time or a
// count it gives the draws of that thing.
[[nodiscard]] constexpr std::uint32_t hashOf(std::uint32_t seed,
                                             Stream stream,
                                             std::uint32_t thing) {
    return hashOf(hashOf(seed, stream), thing);
}

}  // namespace aquarama
