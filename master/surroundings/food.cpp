// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/food.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/base/random_streams.h"
#include "common/place/current.h"
#include "common/place/place.h"

namespace aquarama::surroundings {

namespace {

// Ticks before eaten plankton is replaced: this, and up to as much again.
constexpr std::uint32_t kShortestAbsence = 20 * 60;
// Each tick checks one of kTurns parts of the plankton against sand, rocks and borders: each
// particle about once in four seconds.
constexpr std::uint64_t kTurns = 256;
// Places drawn for a particle until one is clear of rocks; the last one is used anyway.
constexpr int kPlacesTried = 8;

// Room that plankton keeps from what fish turn back at: borders, rocks, sand and surface.
constexpr float kShoreMetres = 0.5F;
constexpr float kRockRoomMetres = 0.6F;
constexpr float kFloorRoomMetres = 0.7F;
constexpr float kSurfaceRoomMetres = 0.9F;

// Metres a tick that a pellet sinks: feed of some millimetres.
constexpr float kSinkMetres = 0.05F / 60;
// Ticks for which a pellet lies on the sand.
constexpr std::uint32_t kLiesTicks = 20 * 60;
// Sand this far below the water of the fish is too deep for a pellet to reach.
constexpr float kDeepMetres = 3;
// Height of a pellet's middle over the sand on which it lies.
constexpr float kPelletOnSandMetres = 0.02F;
// Pellets dropped together spread by this much to each side.
constexpr float kSpreadMetres = 0.3F;
// Greatest velocity of the swell, metres a second: level, and up or down.
constexpr float kSwellMetres = 0.03F;
constexpr float kSwellUpMetres = 0.008F;
// Longest period of the swell: some three minutes.
constexpr std::uint64_t kSwellTicks = 12'288;
// Seconds in a tick.
constexpr float kPerTick = 1.0F / static_cast<float>(kTicksPerSecond);

// The water less a margin, where plankton may be; in small water half of it.
place::Region reachable(const place::Region& water) {
    const auto within = [](float half) { return std::max(half - kShoreMetres, 0.5F * half); };
    return {water.centre,
            {within(water.halfExtent.x), within(water.halfExtent.y), within(water.halfExtent.z)}};
}

float lowestAt(const place::Obstacles& obstacles, float x, float z) {
    return place::floorHeight(obstacles.place, {x, z}) + kFloorRoomMetres;
}

bool isWithin(const place::Region& water, glm::vec3 place) {
    const glm::vec3 from = place - water.centre;
    return std::abs(from.x) < water.halfExtent.x && std::abs(from.y) < water.halfExtent.y &&
           std::abs(from.z) < water.halfExtent.z;
}

bool isClear(const place::Obstacles& obstacles, glm::vec3 place) {
    static_assert(kRockRoomMetres <= place::kChartReachMetres);
    const auto isIn = [&](const place::Rock& rock) {
        return place::lengthOf(place - rock.centre) < rock.radiusMetres + kRockRoomMetres;
    };
    return !place::anyRockNear(obstacles, {place.x, place.z}, place.y - 2 * kRockRoomMetres, isIn);
}

// Where a particle appears: anywhere, or in the tenth of the water from which the current comes.
enum class Origin : std::uint8_t { Anywhere, Left, Right };

Origin upCurrent(glm::vec3 open) {
    return open.x > 0 ? Origin::Left : open.x < 0 ? Origin::Right : Origin::Anywhere;
}

// A random place for a particle; `turn` distinguishes its appearances. Heights are limited by sand
// and surface.
glm::vec3 strewn(std::uint32_t seed,
                 const place::Obstacles& obstacles,
                 std::uint32_t particle,
                 std::uint32_t turn,
                 Origin origin) {
    const place::Region water = reachable(obstacles.water);
    glm::vec3 place{};
    for (std::uint32_t i = 0; i < kPlacesTried; ++i) {
        const std::uint32_t hash =
            hashOf(hashOf(hashOf(seed, Stream::FoodPlace, particle), turn), i);
        glm::vec3 share{
            signedUnitOf(hash), signedUnitOf(hashOf(hash, 1)), signedUnitOf(hashOf(hash, 2))};
        if (origin == Origin::Left) share.x = -0.9F + 0.1F * share.x;
        if (origin == Origin::Right) share.x = 0.9F + 0.1F * share.x;
        place = water.centre + water.halfExtent * share;
        place.y =
            std::min(std::max(place.y, lowestAt(obstacles, place.x, place.z)), -kSurfaceRoomMetres);
        if (isClear(obstacles, place)) break;
    }
    return place;
}

// Fills an element with a new particle.
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
           const place::Obstacles& obstacles,
           std::uint32_t i,
           std::uint32_t turn,
           Origin origin = Origin::Anywhere) {
    const glm::vec3 place = strewn(seed, obstacles, i, turn, origin);
    put(food, i, FoodKind::Plankton, place, lowestAt(obstacles, place.x, place.z));
}

// The swell of one tick: three products of a wave and a factor that vanishes at the border.
struct Swell {
    glm::vec3 centre, perHalf;
    float time;  // cycles of the longest period

    Swell(const place::Region& water, Tick tick)
        : centre(water.centre),
          perHalf(1 / water.halfExtent.x, 1 / water.halfExtent.y, 1 / water.halfExtent.z),
          time(static_cast<float>(tick.value % kSwellTicks) / static_cast<float>(kSwellTicks)) {}

    // Each component has a whole number of cycles in the longest period, so that nothing jumps when
    // the period starts again. At a border the flow across it is 0: no particle leaves.
    [[nodiscard]] float alongX(float x, float y, float z) const {
        return kSwellMetres * calm(x, centre.x, perHalf.x) *
               place::wave(0.11F * z + 0.17F * y + 3 * time);
    }
    [[nodiscard]] float alongY(float x, float y, float z) const {
        return kSwellUpMetres * calm(y, centre.y, perHalf.y) *
               place::wave(0.23F * x + 0.19F * z + 11 * time);
    }
    [[nodiscard]] float alongZ(float x, float y, float z) const {
        return kSwellMetres * calm(z, centre.z, perHalf.z) *
               place::wave(0.13F * x + 0.15F * y + 5 * time);
    }
    [[nodiscard]] static float calm(float at, float centre, float perHalf) {
        const float share = (at - centre) * perHalf;
        // Not clamped beyond the border: a particle that gets there is placed anew.
        return 1 - share * share;
    }
};

// Moves all plankton, present or absent, in a loop without branches, so that it vectorises. The
// swell is passed by value and the arrays are __restrict: else the compiler must assume that
// storing a position changes them.
void drift(Food& food, std::size_t count, const Swell swell, const glm::vec3 open) {
    float* const __restrict x = food.x.data();
    float* const __restrict y = food.y.data();
    float* const __restrict z = food.z.data();
    for (std::size_t i = 0; i < count; ++i) {
        const float atX = x[i];
        const float atY = y[i];
        const float atZ = z[i];
        x[i] = atX + kPerTick * (swell.alongX(atX, atY, atZ) + open.x);
        y[i] = atY + kPerTick * (swell.alongY(atX, atY, atZ) + open.y);
        z[i] = atZ + kPerTick * (swell.alongZ(atX, atY, atZ) + open.z);
    }
}

// Whether the tick has come. The difference is signed, so that 32-bit overflow does not matter.
bool isDue(const Food& food, std::size_t i, std::uint32_t now) {
    return static_cast<std::int32_t>(now - food.absentUntil[i]) >= 0;
}

// Brings one element of plankton up to date: its lowest height where it drifted to, a new place
// where it left the clear water, and a new particle where it is due.
void lookAfter(Food& food,
               std::uint32_t seed,
               const place::Obstacles& obstacles,
               Origin origin,
               std::uint32_t i,
               std::uint32_t now) {
    if (food.isThere(i)) {
        food.lowest[i] = lowestAt(obstacles, food.x[i], food.z[i]);
        food.y[i] = std::max(food.y[i], food.lowest[i]);
        const bool fits =
            isWithin(obstacles.water, food.position(i)) && isClear(obstacles, food.position(i));
        if (food.taken[i] == 0 && !fits) strew(food, seed, obstacles, i, now, origin);
    } else if (isDue(food, i, now)) {
        strew(food, seed, obstacles, i, now);
    }
}

// One tick of a pellet; removes it when it is due. One in a mouth stays.
void sink(Food& food, std::size_t i, std::uint32_t now) {
    if (food.taken[i] != 0) return;
    food.y[i] = std::max(food.y[i] - kSinkMetres, food.lowest[i]);
    if (!isDue(food, i, now)) return;
    food.kind[i] = FoodKind::None;
    --food.pellets;
}

}  // namespace

Food makeFood(std::uint32_t seed, const place::Obstacles& obstacles, std::uint32_t plankton) {
    // Plankton first, pellets behind.
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

void driftFood(
    Food& food, std::uint32_t seed, const place::Obstacles& obstacles, glm::vec3 open, Tick tick) {
    assert(food.size() >= kMostPellets);
    // Behind the plankton are the elements of pellets.
    const std::size_t plankton = food.size() - kMostPellets;
    const auto now = static_cast<std::uint32_t>(tick.value);
    drift(food, plankton, Swell(reachable(obstacles.water), tick), open);
    const std::uint64_t turn = tick.value % kTurns;
    const auto until = static_cast<std::uint32_t>(plankton * (turn + 1) / kTurns);
    for (auto i = static_cast<std::uint32_t>(plankton * turn / kTurns); i < until; ++i)
        lookAfter(food, seed, obstacles, upCurrent(open), i, now);
    for (std::size_t i = plankton; i < food.size(); ++i)
        if (food.isThere(i)) sink(food, i, now);
}

void shiftTime(Food& food, std::uint64_t ticks) {
    for (std::uint32_t& until : food.absentUntil) until -= static_cast<std::uint32_t>(ticks);
}

void dropPellets(Food& food,
                 std::uint32_t seed,
                 const place::Obstacles& obstacles,
                 glm::vec3 position,
                 std::uint32_t pellets,
                 Tick tick) {
    assert(food.size() >= kMostPellets);
    const auto now = static_cast<std::uint32_t>(tick.value);
    for (std::size_t i = food.size() - kMostPellets; i < food.size() && pellets > 0; ++i) {
        if (food.isThere(i)) continue;
        const std::uint32_t hash = hashOf(hashOf(seed, Stream::FoodSpread, now), pellets--);
        const glm::vec3 aside{
            signedUnitOf(hash), signedUnitOf(hashOf(hash, 1)), signedUnitOf(hashOf(hash, 2))};
        glm::vec3 place = position + aside * kSpreadMetres;
        const float sand =
            place::floorHeight(obstacles.place, {place.x, place.z}) + kPelletOnSandMetres;
        const float deepest = obstacles.water.centre.y - obstacles.water.halfExtent.y;
        place.y = std::min(std::max(place.y, sand), 0.0F);
        put(food, i, FoodKind::Pellet, place, sand);
        ++food.pellets;
        // It dissolves when it has lain on the sand; where the sand is far below the fish, as it
        // leaves their water.
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
    assert(particle < food.size());
    if (food.kind[particle] == FoodKind::Pellet) --food.pellets;
    food.kind[particle] = FoodKind::None;
    food.taken[particle] = 0;
    const auto now = static_cast<std::uint32_t>(tick.value);
    food.absentUntil[particle] =
        now + kShortestAbsence + hashOf(particle, Stream::FoodAbsence, now) % kShortestAbsence;
}

glm::vec3 swellAt(const place::Region& water, glm::vec3 position, Tick tick) {
    const Swell swell(reachable(water), tick);
    return {swell.alongX(position.x, position.y, position.z),
            swell.alongY(position.x, position.y, position.z),
            swell.alongZ(position.x, position.y, position.z)};
}

}  // namespace aquarama::surroundings
