// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/food.h"

#include <algorithm>
#include <cmath>

#include "common/place/place.h"
#include "common/units/random_streams.h"

namespace aquarama::surroundings {

namespace {

constexpr std::uint32_t kShortestAbsence = 20 * 60;  // ticks
// Particles are looked after in turns: each about once in four seconds.
constexpr std::uint64_t kTurns = 256;
constexpr int kPlacesTried = 8;

constexpr float kShoreMetres = 0.5F;      // no plankton so near to a border: fish turn back there
constexpr float kRockRoomMetres = 0.6F;   // nor so near to a rock
constexpr float kFloorRoomMetres = 0.7F;  // nor to the sand
constexpr float kSurfaceRoomMetres = 0.9F;

constexpr float kSinkMetres = 0.05F / 60;      // a tick: feed of some millimetres
constexpr std::uint32_t kLiesTicks = 20 * 60;  // on the sand
constexpr float kDeepMetres = 3;               // under the water of the fish
constexpr float kPelletOnSandMetres = 0.02F;   // of its middle over the sand
constexpr float kSpreadMetres = 0.3F;          // of pellets that are dropped together
constexpr float kCurrentMetres = 0.03F;        // a second
constexpr float kCurrentUpMetres = 0.008F;     // a second
constexpr std::uint64_t kSwellTicks = 12'288;  // of its longest period, some three minutes
constexpr float kPerTick = 1.0F / static_cast<float>(kTicksPerSecond);

// Where plankton may be.
place::Region reachable(const place::Region& water) {
    const auto within = [](float half) { return std::max(half - kShoreMetres, 0.5F * half); };
    return {water.centre,
            {within(water.halfExtent.x), within(water.halfExtent.y), within(water.halfExtent.z)}};
}

float lowestAt(const Obstacles& obstacles, float x, float z) {
    return place::floorHeight(obstacles.place, {x, z}) + kFloorRoomMetres;
}

bool isWithin(const place::Region& water, glm::vec3 place) {
    const glm::vec3 from = place - water.centre;
    return std::abs(from.x) < water.halfExtent.x && std::abs(from.y) < water.halfExtent.y &&
           std::abs(from.z) < water.halfExtent.z;
}

bool isClear(const Obstacles& obstacles, glm::vec3 place) {
    return std::ranges::none_of(obstacles.rocks, [&](const place::Rock& rock) {
        return place::lengthOf(place - rock.centre) < rock.radiusMetres + kRockRoomMetres;
    });
}

glm::vec3 strewn(std::uint32_t seed,
                 const Obstacles& obstacles,
                 std::uint32_t particle,
                 std::uint32_t turn) {
    const place::Region water = reachable(obstacles.water);
    glm::vec3 place{};
    for (std::uint32_t i = 0; i < kPlacesTried; ++i) {
        const std::uint32_t hash =
            hashOf(hashOf(hashOf(hashOf(seed, Stream::FoodPlace), particle), turn), i);
        const glm::vec3 share{
            signedUnitOf(hash), signedUnitOf(hashOf(hash, 1)), signedUnitOf(hashOf(hash, 2))};
        place = water.centre + water.halfExtent * share;
        place.y =
            std::min(std::max(place.y, lowestAt(obstacles, place.x, place.z)), -kSurfaceRoomMetres);
        if (isClear(obstacles, place)) break;
    }
    return place;
}

void put(Food& food, std::size_t i, FoodKind kind, glm::vec3 position, float lowest) {
    food.x[i] = position.x;
    food.y[i] = position.y;
    food.z[i] = position.z;
    food.lowest[i] = lowest;
    food.kind[i] = kind;
    food.taken[i] = 0;
    ++food.generation[i];
}

void strew(Food& food,
           std::uint32_t seed,
           const Obstacles& obstacles,
           std::uint32_t i,
           std::uint32_t turn) {
    const glm::vec3 place = strewn(seed, obstacles, i, turn);
    put(food, i, FoodKind::Plankton, place, lowestAt(obstacles, place.x, place.z));
}

// A wave between -1 and 1 of parabolas, period 1: it stands for a sine.
inline float wave(float cycles) {
    const float t = cycles - static_cast<float>(static_cast<std::int32_t>(cycles + 4096.0F) - 4096);
    const float half = 2 * t - 1;
    return -4 * half * (1 - std::abs(half));
}

// The swell of one tick.
struct Swell {
    glm::vec3 centre, perHalf;
    float time;  // cycles of the longest period

    Swell(const place::Region& water, Tick tick)
        : centre(water.centre),
          perHalf(1 / water.halfExtent.x, 1 / water.halfExtent.y, 1 / water.halfExtent.z),
          time(static_cast<float>(tick.value % kSwellTicks) / static_cast<float>(kSwellTicks)) {}

    // Whole cycles in the longest period, so that nothing jumps when it begins anew; no way out at
    // a border, as the flow across it ends there.
    [[nodiscard]] float alongX(float x, float y, float z) const {
        return kCurrentMetres * calm(x, centre.x, perHalf.x) *
               wave(0.11F * z + 0.17F * y + 3 * time);
    }
    [[nodiscard]] float alongY(float x, float y, float z) const {
        return kCurrentUpMetres * calm(y, centre.y, perHalf.y) *
               wave(0.23F * x + 0.19F * z + 11 * time);
    }
    [[nodiscard]] float alongZ(float x, float y, float z) const {
        return kCurrentMetres * calm(z, centre.z, perHalf.z) *
               wave(0.13F * x + 0.15F * y + 5 * time);
    }
    [[nodiscard]] static float calm(float at, float centre, float perHalf) {
        const float share = (at - centre) * perHalf;
        // Not cut off beyond the border: what gets there is strewn anew.
        return 1 - share * share;
    }
};

// All plankton, there or not: a loop without branches.
// The swell by value and the arrays apart: else the compiler could not know that storing a place
// changes neither, and would not vectorise.
void drift(Food& food, std::size_t count, const Swell swell) {
    float* const __restrict x = food.x.data();
    float* const __restrict y = food.y.data();
    float* const __restrict z = food.z.data();
    for (std::size_t i = 0; i < count; ++i) {
        const float atX = x[i];
        const float atY = y[i];
        const float atZ = z[i];
        x[i] = atX + kPerTick * swell.alongX(atX, atY, atZ);
        y[i] = atY + kPerTick * swell.alongY(atX, atY, atZ);
        z[i] = atZ + kPerTick * swell.alongZ(atX, atY, atZ);
    }
}

bool isDue(const Food& food, std::size_t i, std::uint32_t now) {
    return static_cast<std::int32_t>(now - food.absentUntil[i]) >= 0;
}

// The sand under it has changed as it drifted, or it is due again.
void lookAfter(Food& food,
               std::uint32_t seed,
               const Obstacles& obstacles,
               std::uint32_t i,
               std::uint32_t now) {
    if (food.isThere(i)) {
        food.lowest[i] = lowestAt(obstacles, food.x[i], food.z[i]);
        food.y[i] = std::max(food.y[i], food.lowest[i]);
        const bool fits =
            isWithin(obstacles.water, food.position(i)) && isClear(obstacles, food.position(i));
        if (food.taken[i] == 0 && !fits) strew(food, seed, obstacles, i, now);
    } else if (isDue(food, i, now)) {
        strew(food, seed, obstacles, i, now);
    }
}

void sink(Food& food, std::size_t i, std::uint32_t now) {
    if (food.taken[i] != 0) return;
    food.y[i] = std::max(food.y[i] - kSinkMetres, food.lowest[i]);
    if (!isDue(food, i, now)) return;
    food.kind[i] = FoodKind::None;
    --food.pellets;
}

}  // namespace

Food makeFood(std::uint32_t seed, const Obstacles& obstacles, std::uint32_t plankton) {
    const std::size_t room = plankton + kMostPellets;
    Food food{std::vector<float>(room),
              std::vector<float>(room),
              std::vector<float>(room),
              std::vector<float>(room),
              std::vector<FoodKind>(room),
              std::vector<std::uint8_t>(room),
              std::vector<std::uint8_t>(room),
              std::vector<std::uint32_t>(room)};
    for (std::uint32_t i = 0; i < plankton; ++i) strew(food, seed, obstacles, i, 0);
    return food;
}

void driftFood(Food& food, std::uint32_t seed, const Obstacles& obstacles, Tick tick) {
    const std::size_t plankton = food.size() - kMostPellets;
    const auto now = static_cast<std::uint32_t>(tick.value);
    drift(food, plankton, Swell(reachable(obstacles.water), tick));
    const std::uint64_t turn = tick.value % kTurns;
    const auto until = static_cast<std::uint32_t>(plankton * (turn + 1) / kTurns);
    for (auto i = static_cast<std::uint32_t>(plankton * turn / kTurns); i < until; ++i)
        lookAfter(food, seed, obstacles, i, now);
    for (std::size_t i = plankton; i < food.size(); ++i)
        if (food.isThere(i)) sink(food, i, now);
}

void dropPellets(Food& food,
                 std::uint32_t seed,
                 const Obstacles& obstacles,
                 glm::vec3 position,
                 std::uint32_t pellets,
                 Tick tick) {
    const auto now = static_cast<std::uint32_t>(tick.value);
    for (std::size_t i = food.size() - kMostPellets; i < food.size() && pellets > 0; ++i) {
        if (food.isThere(i)) continue;
        const std::uint32_t hash = hashOf(hashOf(hashOf(seed, Stream::FoodSpread), now), pellets--);
        const glm::vec3 aside{
            signedUnitOf(hash), signedUnitOf(hashOf(hash, 1)), signedUnitOf(hashOf(hash, 2))};
        glm::vec3 place = position + aside * kSpreadMetres;
        const float sand =
            place::floorHeight(obstacles.place, {place.x, place.z}) + kPelletOnSandMetres;
        const float deepest = obstacles.water.centre.y - obstacles.water.halfExtent.y;
        place.y = std::min(std::max(place.y, sand), 0.0F);
        put(food, i, FoodKind::Pellet, place, sand);
        ++food.pellets;
        // Where the sand is far below the fish it dissolves as it leaves their water.
        const bool lies = sand > deepest - kDeepMetres;
        const float sinks = std::max(0.0F, place.y - (lies ? sand : deepest));
        food.absentUntil[i] =
            now + static_cast<std::uint32_t>(sinks / kSinkMetres) + (lies ? kLiesTicks : 0);
    }
}

bool takeFood(Food& food, std::uint32_t particle) {
    if (particle >= food.size() || !food.isFree(particle)) return false;
    food.taken[particle] = 1;
    return true;
}

void removeFood(Food& food, std::uint32_t particle, Tick tick) {
    if (food.kind[particle] == FoodKind::Pellet) --food.pellets;
    food.kind[particle] = FoodKind::None;
    food.taken[particle] = 0;
    const auto now = static_cast<std::uint32_t>(tick.value);
    food.absentUntil[particle] =
        now + kShortestAbsence +
        hashOf(hashOf(particle, Stream::FoodAbsence), now) % kShortestAbsence;
}

glm::vec3 currentAt(const place::Region& water, glm::vec3 position, Tick tick) {
    const Swell swell(reachable(water), tick);
    return {swell.alongX(position.x, position.y, position.z),
            swell.alongY(position.x, position.y, position.z),
            swell.alongZ(position.x, position.y, position.z)};
}

}  // namespace aquarama::surroundings
