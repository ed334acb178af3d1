// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/surroundings.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/base/digest.h"
#include "common/base/hash.h"
#include "common/place/place.h"

namespace aquarama::surroundings {

namespace {

// Drops the food that the scene has scheduled up to this tick.
void dropWhatIsDue(Surroundings& surroundings, Tick tick) {
    const double now = static_cast<double>(tick.value) / static_cast<double>(kTicksPerSecond);
    for (; surroundings.nextDrop < surroundings.drops.size(); ++surroundings.nextDrop) {
        const config::FoodDrop& drop = surroundings.drops[surroundings.nextDrop];
        if (drop.atSeconds > now) return;
        dropPellets(surroundings.food,
                    surroundings.seed,
                    surroundings.obstacles,
                    drop.position,
                    drop.pellets,
                    tick);
    }
}

// Greatest share of the half height of the water that the ball takes.
constexpr float kHeightOfMill = 0.75F;
// Period of rising and sinking.
constexpr std::uint64_t kTicksOfMill = std::uint64_t{20} * 60;
// Above and below the middle.
constexpr float kRiseMetres = 0.5F;
// Radius of a ball of one fish, in body lengths: 0.36 in a dense ball, times 1.6, because a living
// ball is stirred and takes more room.
constexpr float kRoomOfMill = 0.36F * 1.6F;

// Cube root by Newton's method with a fixed number of steps: libm differs between machines. 60
// steps reach float precision for up to kMostFish.
float cubeRoot(float x) {
    float root = std::max(1.0F, x);
    for (int i = 0; i < 60; ++i) root -= (root - x / (root * root)) / 3;
    return root;
}

// Radius of a round ball; its volume grows with the number of fish.
float ballRadius(std::size_t fish, float lengthMetres) {
    return kRoomOfMill * lengthMetres * cubeRoot(static_cast<float>(fish));
}

// How active predators are, by phase: dawn, morning, noon, afternoon, sunset, dusk, night, first
// light.
constexpr place::ByPhase kHuntersActive{0.5F, 0, 0, 0, 0.3F, 1, 1, 0.8F};

// The time of day of a tick, and the light then.
void takeTimeOf(Surroundings& surroundings, Tick tick) {
    std::optional<DayCue>& cue = surroundings.dayCue;
    if (cue && isOver(*cue, tick)) cue.reset();
    const double clock = place::timeOfDayAt(surroundings.clock, tick);
    surroundings.timeOfDay = cue ? timeOfDayAt(*cue, clock, tick) : clock;
    surroundings.daylight = place::daylightAt(surroundings.climate.day, surroundings.timeOfDay);
}

}  // namespace

Surroundings makeSurroundings(const config::Scene& scene,
                              std::uint32_t seed,
                              std::size_t fish,
                              float meanLengthMetres) {
    const place::PlaceKey place = place::placeOf(scene, seed);
    const place::Obstacles obstacles =
        place::obstaclesOf(place, place::waterFor(scene, fish, meanLengthMetres));
    const std::vector<place::Site> sites = place::sitesOf(place);
    const place::DayClock clock = place::clockOf(scene.day);
    return {.seed = seed,
            .obstacles = obstacles,
            .sites = sites,
            .structures = structuresOf(obstacles),
            .turf = makeTurf(seed, sites, obstacles),
            .current = {scene.current, obstacles.rocks, obstacles.water},
            .climate = climateOf(scene),
            .food = makeFood(seed, obstacles, scene.plankton),
            .submarine = {.position = scene.eye},
            .clarityMetres = static_cast<float>(scene.water.clarityMetres),
            .clock = clock,
            .timeOfDay = clock.timeOfDay,
            .daylight = place::daylightAt(scene.day, clock.timeOfDay),
            .drops = scene.drops};
}

void setClock(Surroundings& surroundings, const place::DayClock& clock) {
    surroundings.clock = clock;
    takeTimeOf(surroundings, clock.since);
}

void setDay(Surroundings& surroundings,
            std::optional<double> timeOfDay,
            std::uint64_t ticks,
            Tick tick) {
    std::optional<DayCue>& cue = surroundings.dayCue;
    const bool isTheSame = cue ? cue->holds == timeOfDay : !timeOfDay;
    if (isTheSame) return;
    const double goal = timeOfDay.value_or(place::timeOfDayAt(surroundings.clock, tick));
    cue = {timeOfDay, tick, wayBetween(surroundings.timeOfDay, goal), ticks};
    takeTimeOf(surroundings, tick);
}

void advanceSurroundings(Surroundings& surroundings, Tick tick, std::uint64_t unseen) {
    takeTimeOf(surroundings, unseen > 0 ? surroundings.clock.since : tick);
    surroundings.openCurrent = surroundings.current.open(
        unseen > 0 ? -static_cast<std::int64_t>(unseen) : static_cast<std::int64_t>(tick.value));
    if (unseen == 0) dropWhatIsDue(surroundings, tick);
    growTurf(surroundings.turf);
    driftFood(surroundings.food,
              surroundings.seed,
              surroundings.obstacles,
              surroundings.openCurrent,
              tick);
}

float huntersActive(const Surroundings& surroundings) {
    return place::valueAt(kHuntersActive, surroundings.timeOfDay);
}

std::uint64_t foldedSurroundings(std::uint64_t hash, const Surroundings& surroundings) {
    const Food& food = surroundings.food;
    for (const auto* values : {&food.x, &food.y, &food.z, &food.lowest})
        hash = folded(hash, *values);
    hash = folded(hash, food.kind);
    hash = folded(hash, food.taken);
    hash = folded(hash, food.generation);
    hash = folded(hash, food.absentUntil);
    hash = folded(hash, surroundings.turf.fill);
    for (const Structure& structure : surroundings.structures)
        hash = foldedOne(foldedOne(hash, structure.tiredOf), structure.fright);
    hash = foldedCue(foldedHands(hash, surroundings.hands), surroundings.dayCue);
    // A clock that nobody can set is a function of scene and tick.
    if (!surroundings.climate.day.followsHall) return hash;
    const place::DayClock& clock = surroundings.clock;
    return foldedOne(foldedOne(foldedOne(hash, clock.since.value), clock.timeOfDay),
                     clock.lengthSeconds);
}

float millRadiusMetres(const place::Region& water, std::size_t fish, float lengthMetres) {
    assert(lengthMetres > 0);
    assert(water.halfExtent.y > 0);
    const float ball = ballRadius(fish, lengthMetres);
    // A ball too high for the water keeps its volume: it is flattened and gets broader.
    const float high = std::min(ball, kHeightOfMill * water.halfExtent.y);
    return ball * std::sqrt(ball / high);
}

Goal millGoal(std::uint32_t seed, const place::Region& water, float radius, Tick tick) {
    assert(radius > 0);
    const float u = static_cast<float>(tick.value % kTicksOfMill) / float{kTicksOfMill};
    // Smoothstep up in the first half of the period and down in the second.
    const float half = u < 0.5F ? 2 * u : 2 - 2 * u;
    const float risen = half * half * (3 - 2 * half);
    const float slope = (u < 0.5F ? 1.0F : -1.0F) * 12 * half * (1 - half);  // a round
    const float seconds = float{kTicksOfMill} / float{kTicksPerSecond};
    const float metres = std::min(kRiseMetres, 0.25F * water.halfExtent.y);
    return {water.centre + glm::vec3{0, (2 * risen - 1) * metres, 0},
            {0, 2 * slope * metres / seconds, 0},
            (hashOf(seed) & 1U) != 0 ? 1.0F : -1.0F,
            std::min(1.0F, kHeightOfMill * water.halfExtent.y / radius)};
}

}  // namespace aquarama::surroundings
