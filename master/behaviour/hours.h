// SPDX-License-Identifier: Apache-2.0
// What the time of day does to fish: when they rest, and by which factors they live otherwise at
// dusk and at night (docs/minds.md).
#pragma once

#include <cstdint>

#include "common/place/day.h"
#include "master/behaviour/perceive.h"
#include "master/fish/fish_view.h"

namespace aquarama::behaviour {

// Factors and lengths by phase, in the order of the day: dawn, morning, noon, afternoon, sunset,
// dusk, night, first light. They are exactly 1, or 0, by day.

// Of the height of a cloud over its home.
inline constexpr place::ByPhase kCloudHeight{0.75F, 1, 1, 1, 0.5F, 0.5F, 0.5F, 0.5F};
// Of a school: the distance between neighbours, the speed, and how strongly a fish takes the course
// of its neighbours, and draws near to them and to the goal of the school. At dusk it spreads,
// faster and more aligned (Capello 2013); at night its fish swim singly.
inline constexpr place::ByPhase kSchoolSpacing{1, 1, 1, 1, 1, 1.6F, 2.5F, 1.3F};
inline constexpr place::ByPhase kSchoolSpeed{1, 1, 1, 1, 1, 1.4F, 0.8F, 1};
inline constexpr place::ByPhase kSchoolAlignment{1, 1, 1, 1, 1, 1.3F, 0.1F, 0.7F};
inline constexpr place::ByPhase kSchoolCohesion{1, 1, 1, 1, 1, 1, 0.15F, 0.8F};
// Of predators: the time between two chases, and how much deeper than by day they patrol, metres.
inline constexpr place::ByPhase kBetweenChases{0.8F, 1, 1, 1, 0.8F, 0.4F, 0.6F, 0.6F};
inline constexpr place::ByPhase kPatrolsDeeper{0.5F, 0, 0, 0, 0.5F, 1.5F, 1.5F, 1};

// The rank of a fish by size within its species, 0 the smallest to 1.
[[nodiscard]] float sizeRankOf(const fish::SpeciesParameters& parameters, float lengthMetres);

// Whether a fish of this length is outside the active hours of its species. Each fish has times of
// its own: the larger are active longer.
[[nodiscard]] bool restsAt(const fish::SpeciesParameters& parameters,
                           std::uint32_t seed,
                           std::uint32_t fish,
                           float lengthMetres,
                           double timeOfDay);

// Writes rests, mates and restBetweenChases of a fish whose length is sensed.
void feelTheHour(const Environment& environment,
                 const fish::SpeciesParameters& parameters,
                 std::uint32_t fish,
                 Senses& senses);

}  // namespace aquarama::behaviour
