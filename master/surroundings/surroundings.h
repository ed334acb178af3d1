// SPDX-License-Identifier: Apache-2.0
// The world that the fish live in: obstacles, climate, food and submarine; and the goal of the
// school.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <glm/vec3.hpp>

#include "common/base/units.h"
#include "common/config/scene.h"
#include "common/place/current.h"
#include "common/place/day.h"
#include "common/place/obstacles.h"
#include "common/place/place.h"
#include "common/place/sites.h"
#include "master/surroundings/climate.h"
#include "master/surroundings/day_cue.h"
#include "master/surroundings/food.h"
#include "master/surroundings/hands.h"
#include "master/surroundings/structures.h"
#include "master/surroundings/turf.h"

namespace aquarama::surroundings {

// The submarine as fish perceive it.
struct Submarine {
    // Position of the eye, metres, world frame.
    glm::vec3 position{};
    glm::vec3 velocityMetresPerSecond{};
    // No fish comes nearer: it would fill the wall.
    float radiusMetres = 0.9F;
};

// Owned by the world. advanceSurroundings() and inputs change it between thoughts; while fish think
// it is constant.
struct Surroundings {
    std::uint32_t seed = 0;
    place::Obstacles obstacles;
    // Of the whole place, in the scene's order; constant.
    std::vector<place::Site> sites;
    // Only what schools remember of them changes.
    std::vector<Structure> structures;
    Turf turf;
    place::Current current;
    Climate climate;
    Food food;
    Submarine submarine;
    HeldHands hands = makeHands();
    // No fish sees farther than this.
    float clarityMetres = 12;
    // The clock of the day, the cue that holds instead, if any, the time of day at this tick and
    // the light of the sky then, 0 to 1.
    place::DayClock clock;
    std::optional<DayCue> dayCue = {};
    double timeOfDay = 0.5;
    float daylight = 1;
    // Velocity of the water far from boulders at this tick, metres a second.
    glm::vec3 openCurrent{};
    // Food that the scene drops, in order of time, and the index of the next one.
    std::vector<config::FoodDrop> drops;
    std::size_t nextDrop = 0;
};

// Surroundings at tick 0 for a scene with so many fish of this mean length; the water grows with
// them (place::waterFor()).
[[nodiscard]] Surroundings makeSurroundings(const config::Scene& scene,
                                            std::uint32_t seed,
                                            std::size_t fish,
                                            float meanLengthMetres);
// Sets the clock of the day at this tick. `clock` has a time of day of 0 to 1 (1 excluded).
void setClock(Surroundings& surroundings, const place::DayClock& clock);
// From this tick on the scene goes to a time of day, in so many ticks, and keeps it; nothing: it
// goes back to that of its clock.
void setDay(Surroundings& surroundings,
            std::optional<double> timeOfDay,
            std::uint64_t ticks,
            Tick tick);
// Advances the day, the current, scheduled food and drifting food by one tick. Of the last `unseen`
// ticks before a show begins nothing is scheduled, and the time of day is that of its beginning.
void advanceSurroundings(Surroundings& surroundings, Tick tick, std::uint64_t unseen = 0);
// How active predators are now: 0 by day, 1 at dusk and by night.
[[nodiscard]] float huntersActive(const Surroundings& surroundings);
// The hash with everything folded in that fish or visitors can change.
[[nodiscard]] std::uint64_t foldedSurroundings(std::uint64_t hash,
                                               const Surroundings& surroundings);

// What draws the school: the middle of a bait ball, or the middle of its own members.
struct Goal {
    glm::vec3 position{};  // metres
    // Velocity of the goal itself.
    glm::vec3 velocityMetresPerSecond{};
    // How far the school circles the goal instead of following it: 1 circles to the left, -1 to the
    // right, 0 follows.
    float mill = 0;
    // Height of the school divided by its breadth.
    float flatness = 1;
};

// A bait ball: the middle of the water. It rises and sinks by up to a metre every 20 s. `radius` is
// millRadiusMetres(), above 0.
[[nodiscard]] Goal millGoal(std::uint32_t seed,
                            const place::Region& water,
                            float radius,
                            Tick tick);
// Radius, in plan, of a ball at ease of so many fish of a mean length. In shallow water it is
// broader than high.
[[nodiscard]] float millRadiusMetres(const place::Region& water,
                                     std::size_t fish,
                                     float lengthMetres);

}  // namespace aquarama::surroundings
