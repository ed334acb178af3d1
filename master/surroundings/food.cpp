// SPDX-License-Identifier: Apache-2.0
#include "master/surroundings/food.h"

#include "common/place/noise.h"

namespace aquarama {

namespace {

enum Draw : std::uint32_t { Place = 401, Absence, Spread };

constexpr std::uint32_t kShortestAbsence = 20 * 60;  // ticks
constexpr std::uint32_t kPelletTicks = 60 * 60;      // then it is gone
constexpr float kSinkMetres = 0.03F / 60;            // a tick
constexpr float kSpreadMetres = 0.35F;

glm::vec3 strewn(std::uint32_t seed,
                 const Region& water,
                 std::uint32_t particle,
                 std::uint32_t turn) {
    const std::uint32_t hash = hashOf(hashOf(hashOf(seed, Place), particle), turn);
    const glm::vec3 share{
        signedUnitOf(hash), signedUnitOf(hashOf(hash, 1)), signedUnitOf(hashOf(hash, 2))};
    return water.centre + water.halfExtent * share;
}

void put(Food& food, std::size_t i, FoodKind kind, glm::vec3 position) {
    food.x[i] = position.x;
    food.y[i] = position.y;
    food.z[i] = position.z;
    food.kind[i] = kind;
    ++food.generation[i];
}

}  // namespace

Food makeFood(std::uint32_t seed, const Region& water, std::uint32_t plankton) {
    const std::size_t room = plankton + kMostPellets;
    Food food{std::vector<float>(room),
              std::vector<float>(room),
              std::vector<float>(room),
              std::vector<FoodKind>(room),
              std::vector<std::uint8_t>(room),
              std::vector<std::uint32_t>(room, 0xffffffffU)};
    for (std::uint32_t i = 0; i < plankton; ++i)
        put(food, i, FoodKind::Plankton, strewn(seed, water, i, 0));
    return food;
}

void driftFood(Food& food, std::uint32_t seed, const Region& water, Tick tick) {
    const std::size_t plankton = food.size() - kMostPellets;
    const auto now = static_cast<std::uint32_t>(tick.value);
    for (std::uint32_t i = 0; i < plankton; ++i) {
        if (!food.isThere(i) && now == food.absentUntil[i])
            put(food, i, FoodKind::Plankton, strewn(seed, water, i, now));
    }
    for (std::size_t i = plankton; i < food.size(); ++i) {
        if (!food.isThere(i)) continue;
        food.y[i] -= kSinkMetres;
        if (now == food.absentUntil[i]) food.kind[i] = FoodKind::None;
    }
}

void dropPellets(
    Food& food, std::uint32_t seed, glm::vec3 position, std::uint32_t pellets, Tick tick) {
    const auto now = static_cast<std::uint32_t>(tick.value);
    for (std::size_t i = food.size() - kMostPellets; i < food.size() && pellets > 0; ++i) {
        if (food.isThere(i)) continue;
        const std::uint32_t hash = hashOf(hashOf(hashOf(seed, Spread), now), pellets--);
        const glm::vec3 aside{
            signedUnitOf(hash), signedUnitOf(hashOf(hash, 1)), signedUnitOf(hashOf(hash, 2))};
        put(food, i, FoodKind::Pellet, position + aside * kSpreadMetres);
        food.absentUntil[i] = now + kPelletTicks;
    }
}

bool eatFood(Food& food, std::uint32_t particle, Tick tick) {
    if (particle >= food.size() || !food.isThere(particle)) return false;
    food.kind[particle] = FoodKind::None;
    const auto now = static_cast<std::uint32_t>(tick.value);
    food.absentUntil[particle] =
        now + kShortestAbsence + hashOf(hashOf(particle, Absence), now) % kShortestAbsence;
    return true;
}

}  // namespace aquarama
