// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/surroundings.h"

#include <algorithm>
#include <array>
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

// A point of the round that the school passes.
struct Station {
    // Metres, before the shift.
    glm::vec3 position;
    // How far the seed may shift it along x and z.
    float shiftMetres;
    // Ticks to the next station.
    std::uint32_t ticks;
    // Whether the school circles on the way there.
    bool mills = false;
};

// One round of the school, staged: it comes from far off along one side into the wings, passes
// close before the eye, goes through the other wing, circles in the middle distance and withdraws.
// Legs are swum at 0.3 to 0.5 m/s. A round may be mirrored in x; so that this makes no jump, the
// first and the last station are near x = 0.
constexpr std::array kRound{
    Station{{0.0F, -5.7F, -7.7F}, 0.4F, 12 * 60},
    Station{{-4.2F, -6.2F, -6.0F}, 0.3F, 7 * 60},
    Station{{-3.8F, -5.9F, -3.2F}, 0.2F, 10 * 60},
    Station{{0.0F, -6.1F, -2.45F}, 0.1F, 10 * 60},
    Station{{3.8F, -5.7F, -3.2F}, 0.2F, 8 * 60},
    Station{{4.1F, -6.3F, -5.8F}, 0.3F, 9 * 60},
    Station{{0.6F, -5.4F, -4.6F}, 0.3F, 16 * 60, true},
    Station{{-0.2F, -5.5F, -5.2F}, 0.3F, 7 * 60},
};
// A show begins this far into the round, when the school comes close: visitors see it at once.
constexpr std::uint64_t kOpeningTicks = std::uint64_t{26} * 60;
// How far the seed may shift a station up or down.
constexpr float kHeightShiftMetres = 0.35F;

constexpr std::uint64_t ticksOfRound() {
    std::uint64_t sum = 0;
    for (const Station& station : kRound) sum += station.ticks;
    return sum;
}

// Station `index`, counted over all rounds, with the shifts of its round.
glm::vec3 stationAt(std::uint32_t seed, std::uint64_t index) {
    const auto round = static_cast<std::uint32_t>(index / kRound.size());
    const Station& station = kRound[index % kRound.size()];
    const std::uint32_t hash = hashOf(seed, static_cast<std::uint32_t>(index));
    const bool mirrored = (hashOf(~seed, round) & 1U) != 0;
    return {(mirrored ? -station.position.x : station.position.x) +
                station.shiftMetres * signedUnitOf(hash),
            station.position.y + kHeightShiftMetres * signedUnitOf(hashOf(hash, 1)),
            station.position.z + station.shiftMetres * signedUnitOf(hashOf(hash, 2))};
}

float secondsOfLeg(std::uint64_t index) {
    return static_cast<float>(kRound[index % kRound.size()].ticks) /
           static_cast<float>(kTicksPerSecond);
}

// The spline's velocity at a station: that of the chord between its neighbours.
glm::vec3 velocityAt(std::uint32_t seed, std::uint64_t index) {
    const float seconds = secondsOfLeg(index - 1) + secondsOfLeg(index);
    assert(seconds > 0);
    return (stationAt(seed, index + 1) - stationAt(seed, index - 1)) / seconds;
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

}  // namespace

Surroundings makeSurroundings(const config::Scene& scene,
                              std::uint32_t seed,
                              std::size_t fish,
                              float meanLengthMetres) {
    const place::PlaceKey place = place::placeOf(scene, seed);
    const Obstacles obstacles = obstaclesOf(place, place::waterFor(scene, fish, meanLengthMetres));
    const place::DayClock clock = place::clockOf(scene.day);
    return {.seed = seed,
            .obstacles = obstacles,
            .sites = place::sitesOf(place),
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
    surroundings.timeOfDay = clock.timeOfDay;
    surroundings.daylight = place::daylightAt(surroundings.climate.day, clock.timeOfDay);
}

void advanceSurroundings(Surroundings& surroundings, Tick tick) {
    surroundings.timeOfDay = place::timeOfDayAt(surroundings.clock, tick);
    surroundings.daylight = place::daylightAt(surroundings.climate.day, surroundings.timeOfDay);
    dropWhatIsDue(surroundings, tick);
    driftFood(surroundings.food,
              surroundings.seed,
              surroundings.obstacles,
              surroundings.current.open(tick),
              tick);
}

std::uint64_t foldedSurroundings(std::uint64_t hash, const Surroundings& surroundings) {
    const Food& food = surroundings.food;
    for (const auto* values : {&food.x, &food.y, &food.z, &food.lowest})
        hash = folded(hash, *values);
    hash = folded(hash, food.kind);
    hash = folded(hash, food.taken);
    hash = folded(hash, food.generation);
    hash = folded(hash, food.absentUntil);
    // A clock that nobody can set is a function of scene and tick.
    if (!surroundings.climate.day.followsHall) return hash;
    const place::DayClock& clock = surroundings.clock;
    return foldedOne(foldedOne(foldedOne(hash, clock.since.value), clock.timeOfDay),
                     clock.lengthSeconds);
}

Goal journeyGoal(std::uint32_t seed, Tick tick) {
    // Rounds count from 1, so that there is always a station before.
    const std::uint64_t played = tick.value + kOpeningTicks;
    std::uint64_t index = (played / ticksOfRound() + 1) * kRound.size();
    std::uint64_t ticks = played % ticksOfRound();
    while (ticks >= kRound[index % kRound.size()].ticks)
        ticks -= kRound[index++ % kRound.size()].ticks;

    // Cubic Hermite interpolation over the leg, with the velocities at both stations.
    const float seconds = secondsOfLeg(index);
    const float u =
        static_cast<float>(ticks) / static_cast<float>(kRound[index % kRound.size()].ticks);
    const glm::vec3 from = stationAt(seed, index);
    const glm::vec3 step = stationAt(seed, index + 1) - from;
    const glm::vec3 leaving = velocityAt(seed, index) * seconds;
    const glm::vec3 arriving = velocityAt(seed, index + 1) * seconds;
    const glm::vec3 square = step * 3.0F - leaving * 2.0F - arriving;
    const glm::vec3 cube = leaving + arriving - step * 2.0F;
    const float side =
        (hashOf(seed, static_cast<std::uint32_t>(index / kRound.size())) & 2U) != 0 ? 1.0F : -1.0F;
    // Circling fades in and out at the ends of its leg.
    const float fade = std::min(1.0F, 12 * u * (1 - u));
    const float mill = kRound[index % kRound.size()].mills ? side * fade : 0.0F;
    return {from + (leaving + (square + cube * u) * u) * u,
            (leaving + (square * 2.0F + cube * (3.0F * u)) * u) / seconds,
            mill};
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
