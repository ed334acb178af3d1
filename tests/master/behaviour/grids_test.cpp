// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/grids.h"

#include <algorithm>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "master/behaviour/neighbours.h"
#include "tests/master/behaviour/scattered_school.h"

namespace aquarama::behaviour {
namespace {

const place::Region kGridWater{{1, -6, -5}, {9, 3, 7}};
constexpr std::size_t kFish = 20000;

struct GridSea {
    fish::FishView view = scatteredSchool(2, kFish, kGridWater);
    surroundings::Food food = surroundings::makeFood(
        3, place::obstaclesOf({3, config::PlaceKind::OpenSea}, kGridWater), 700);
    std::vector<fish::SpeciesParameters> speciesParameters =
        std::vector<fish::SpeciesParameters>(2);

    GridSea() {
        speciesParameters[1].habits.role = config::Role::Predator;
        for (std::size_t fish = 0; fish < kFish; ++fish) {
            if (fish % 5 == 0) view.signs[fish] = fish::kAway;
            if (fish % 7 == 0) view.signs[fish] |= fish::kWilling;
            if (fish % 97 == 0) view.fish[fish].length = 1.4F;
            view.kind[fish] = fish >= kFish - 60 ? 1 : 0;
        }
    }
};

// Jobs in turns on so many threads, the last ones first.
auto onThreads(std::size_t threads) {
    return [threads](std::size_t jobs, const auto& job) {
        std::vector<std::jthread> workers;
        for (std::size_t t = 0; t < threads; ++t)
            workers.emplace_back([&, t] {
                for (std::size_t i = jobs; i-- > 0;)
                    if (i % threads == t) job(i);
            });
    };
}

std::vector<std::uint32_t> indicesIn(const SpatialGrid& grid) {
    return {grid.index(), grid.index() + grid.size()};
}

std::vector<std::uint32_t> startsOf(const SpatialGrid& grid) {
    std::vector<std::uint32_t> starts;
    const SpatialGrid::Cell cells = grid.cells();
    for (int z = 0; z < cells.z; ++z)
        for (int y = 0; y < cells.y; ++y)
            for (int x = 0; x < cells.x; ++x) starts.push_back(grid.slotsOf(x, x, y, z).first);
    return starts;
}

TEST(Grids, areTheSameOnAnyNumberOfThreads) {
    const GridSea sea;
    Grids alone(kGridWater, kFish, sea.food.size());
    alone.rebuild(sea.view, sea.food, sea.speciesParameters);
    for (const std::size_t threads : {1U, 2U, 4U}) {
        SCOPED_TRACE(threads);
        Grids shared(kGridWater, kFish, sea.food.size());
        for (int tick = 0; tick < 3; ++tick)  // what was there before does not matter
            shared.rebuild(
                sea.view, sea.food, sea.speciesParameters, onThreads(threads), [](auto, auto) {});
        for (const auto grid :
             {&Grids::fish, &Grids::predators, &Grids::large, &Grids::mates, &Grids::food}) {
            EXPECT_EQ(indicesIn(shared.*grid), indicesIn(alone.*grid));
            EXPECT_EQ(startsOf(shared.*grid), startsOf(alone.*grid));
        }
        EXPECT_TRUE(
            std::equal(alone.fish.x(), alone.fish.x() + alone.fish.size(), shared.fish.x()));
    }
}

TEST(Grids, everyFishStandsInItsCellInTheOrderOfIndices) {
    const GridSea sea;
    Grids grids(kGridWater, kFish, sea.food.size());
    grids.rebuild(sea.view, sea.food, sea.speciesParameters);
    const SpatialGrid& fish = grids.fish;
    EXPECT_EQ(fish.size(), kFish * 4 / 5);
    const SpatialGrid::Cell cells = fish.cells();
    for (int z = 0; z < cells.z; ++z)
        for (int y = 0; y < cells.y; ++y)
            for (int x = 0; x < cells.x; ++x) {
                const SpatialGrid::Slots slots = fish.slotsOf(x, x, y, z);
                ASSERT_TRUE(std::is_sorted(fish.index() + slots.first, fish.index() + slots.last));
                for (std::uint32_t slot = slots.first; slot < slots.last; ++slot) {
                    const SpatialGrid::Cell cell =
                        fish.cellOf(sea.view.position(fish.index()[slot]));
                    ASSERT_TRUE(cell.x == x && cell.y == y && cell.z == z);
                }
            }
}

TEST(Grids, theSparseOnesHoldThoseTheyAreOf) {
    const GridSea sea;
    Grids grids(kGridWater, kFish, sea.food.size());
    grids.expect(sea.view, sea.speciesParameters);
    grids.rebuild(sea.view, sea.food, sea.speciesParameters);
    const auto expectHolds = [&](const SpatialGrid& grid, const auto& isOne) {
        std::vector<std::uint32_t> those;
        for (std::uint32_t fish = 0; fish < kFish; ++fish)
            if (!sea.view.shows(fish, fish::kAway) && isOne(fish)) those.push_back(fish);
        std::vector<std::uint32_t> held = indicesIn(grid);
        std::sort(held.begin(), held.end());
        EXPECT_EQ(held, those);
    };
    expectHolds(grids.predators, [&](std::uint32_t fish) { return sea.view.kind[fish] == 1; });
    expectHolds(grids.large,
                [&](std::uint32_t fish) { return sea.view.fish[fish].length >= kLargeBodyMetres; });
    expectHolds(grids.mates,
                [&](std::uint32_t fish) { return sea.view.shows(fish, fish::kWilling); });
    EXPECT_EQ(grids.food.size(), 700U);
}

TEST(Grids, aLargeOpenSeaTakesNoMoreMemoryThanItsFishWarrant) {
    const place::Region sea{{0, -10, 0}, {500, 10, 500}};
    EXPECT_LT(Grids(sea, 1000, 0).bytes(), 400'000U);
    EXPECT_FLOAT_EQ(Grids(kGridWater, kFish, 0).fish.cellMetres(), kCellMetres)
        << "where there are fish enough";
}

}  // namespace
}  // namespace aquarama::behaviour
