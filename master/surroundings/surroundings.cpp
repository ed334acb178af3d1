// SPDX-License-Identifier: Apache-2.0

#include "master/surroundings/surroundings.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/place/water.h"
#include "common/units/digest.h"
#include "common/units/hash.h"

namespace aquarama::surroundings {

namespace {

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

}  // namespace

Surroundings makeSurroundings(const config::Scene& scene,
                              std::uint32_t seed,
                              std::size_t fish,
                              float meanLengthMetres) {
    const Obstacles obstacles =
        obstaclesOf({seed, scene.place}, place::waterFor(scene, fish, meanLengthMetres));
    return {.seed = seed,
            .obstacles = obstacles,
            .climate = climateOf(scene),
            .food = makeFood(seed, obstacles, scene.plankton),
            .submarine = {.position = scene.eye},
            .clarityMetres = static_cast<float>(scene.water.clarityMetres),
            .daylight = daylight(scene.day, {}),
            .drops = scene.drops};
}

void advanceSurroundings(Surroundings& surroundings, Tick tick) {
    surroundings.daylight = daylight(surroundings.climate.day, tick);
    dropWhatIsDue(surroundings, tick);
    driftFood(surroundings.food, surroundings.seed, surroundings.obstacles, tick);
}

std::uint64_t foldedSurroundings(std::uint64_t hash, const Surroundings& surroundings) {
    const Food& food = surroundings.food;
    for (const auto* values : {&food.x, &food.y, &food.z, &food.lowest})
        hash = folded(hash, *values);
    hash = folded(hash, food.kind);
    hash = folded(hash, food.taken);
    hash = folded(hash, food.generation);
    hash = folded(hash, food.absentUntil);
    return hash;
}

namespace {

struct Station {
    glm::vec3 position;   // metres, before its shift
    float shiftMetres;    // how far a seed may move it along x and z
    std::uint32_t ticks;  // to the next station
    bool mills = false;   // the school circles on the way there
};

// One round, as an author would stage it: from far off the school comes along one side into the
// wings, passes close before the eye, goes through the other wing, mills in the middle distance and
// withdraws. Legs are swum at 0.3 to 0.5 m/s. A round may be mirrored, so the first and the last
// station stand near the middle.
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
// The curtain rises as the school comes close: what a visitor sees first, and the first picture.
constexpr std::uint64_t kOpeningTicks = 26 * 60;
constexpr float kHeightShiftMetres = 0.35F;

constexpr std::uint64_t ticksOfRound() {
    std::uint64_t sum = 0;
    for (const Station& station : kRound) sum += station.ticks;
    return sum;
}

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
    return (stationAt(seed, index + 1) - stationAt(seed, index - 1)) / seconds;
}

}  // namespace

Goal journeyGoal(std::uint32_t seed, Tick tick) {
    const std::uint64_t played = tick.value + kOpeningTicks;
    std::uint64_t index = (played / ticksOfRound() + 1) * kRound.size();
    std::uint64_t ticks = played % ticksOfRound();
    while (ticks >= kRound[index % kRound.size()].ticks)
        ticks -= kRound[index++ % kRound.size()].ticks;

    // Cubic Hermite over the leg.
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
    const float fade = std::min(1.0F, 12 * u * (1 - u));
    const float mill = kRound[index % kRound.size()].mills ? side * fade : 0.0F;
    return {from + (leaving + (square + cube * u) * u) * u,
            (leaving + (square * 2.0F + cube * (3.0F * u)) * u) / seconds,
            mill};
}

namespace {

constexpr float kHeightOfMill = 0.75F;           // of the water's, at most
constexpr std::uint64_t kTicksOfMill = 20 * 60;  // up and down once
constexpr float kRiseMetres = 0.5F;              // above the middle and below it
// A fish of a dense ball has 0.36 body lengths of room about it; a living one is half as wide again
// and more, as it is stirred.
constexpr float kRoomOfMill = 0.36F * 1.6F;

// By Newton's steps: exact arithmetic on every machine.
float cubeRoot(float x) {
    float root = std::max(1.0F, x);
    for (int i = 0; i < 60; ++i) root -= (root - x / (root * root)) / 3;
    return root;
}

float ballRadius(std::size_t fish, float lengthMetres) {
    return kRoomOfMill * lengthMetres * cubeRoot(static_cast<float>(fish));
}

}  // namespace

float millRadiusMetres(const place::Region& water, std::size_t fish, float lengthMetres) {
    const float ball = ballRadius(fish, lengthMetres);
    const float high = std::min(ball, kHeightOfMill * water.halfExtent.y);
    return ball * std::sqrt(ball / high);
}

Goal millGoal(std::uint32_t seed, const place::Region& water, float radius, Tick tick) {
    const float u = static_cast<float>(tick.value % kTicksOfMill) / float{kTicksOfMill};
    // Smoothstep up and down again.
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
