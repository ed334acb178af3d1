// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/neighbours.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "common/place/place.h"
#include "master/behaviour/grids.h"
#include "tests/master/behaviour/scattered_school.h"
#include "tests/support/instruction_sets.h"

namespace aquarama::behaviour {
namespace {

using Seen = std::pair<float, std::uint32_t>;  // squared distance, fish

// A school of three kinds: most of the first, the rest by halves.
struct School {
    fish::FishView view;
    std::vector<fish::SpeciesParameters> speciesParameters;
    place::Region water;

    School(fish::FishView fish, const place::Region& region)
        : view(std::move(fish)), water(region) {
        const auto size = static_cast<std::uint32_t>(view.size());
        const std::array<std::uint32_t, 4> borders{0, size - size / 4, size - size / 8, size};
        for (std::uint8_t kind = 0; kind < 3; ++kind) {
            fish::SpeciesParameters parameters;
            parameters.kind = kind;
            parameters.first = borders[kind];
            parameters.last = borders[kind + 1U];
            speciesParameters.push_back(parameters);
            std::fill(
                view.kind.data() + parameters.first, view.kind.data() + parameters.last, kind);
        }
    }
    School(std::uint32_t seed, std::size_t fish, const place::Region& region)
        : School(scatteredSchool(seed, fish, region), region) {}

    [[nodiscard]] const fish::SpeciesParameters& makeSpeciesParameters(std::size_t fish) const {
        return speciesParameters[view.kind[fish]];
    }
    [[nodiscard]] Grids grids() const {
        Grids grids(water, view.size(), 0);
        grids.rebuild(view, {}, speciesParameters);
        return grids;
    }
};

std::vector<Seen> seenOf(const Neighbours& found) {
    std::vector<Seen> seen;
    for (std::size_t i = 0; i < found.count; ++i)
        seen.emplace_back(found.distanceSquared[i], found.fish[i]);
    return seen;
}

std::vector<Seen> nearestByBruteForce(const School& school, std::uint32_t fish, bool ownKind) {
    const fish::FishView& view = school.view;
    std::vector<Seen> seen;
    for (std::uint32_t other = 0; other < view.size(); ++other) {
        const glm::vec3 offset = view.position(other) - view.position(fish);
        const float distanceSquared = place::dot(offset, offset);
        if (other != fish && (view.kind[other] == view.kind[fish]) == ownKind &&
            !view.shows(other, fish::kAway) && distanceSquared <= kSightMetres * kSightMetres &&
            inFieldOfView(view.heading(fish), offset))
            seen.emplace_back(distanceSquared, other);
    }
    const std::size_t kept = std::min(seen.size(), kMostNeighbours);
    std::partial_sort(seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(kept), seen.end());
    seen.resize(kept);
    return seen;
}

// Of every step-th fish, by the vectors of the chosen instruction set.
void expectVectorsEqualBruteForce(const School& school, std::uint32_t step = 1) {
    const Grids grids = school.grids();
    for (std::uint32_t fish = 0; fish < school.view.size(); fish += step) {
        const NearestFish found =
            nearestVisible(school.view, grids, school.makeSpeciesParameters(fish), fish);
        ASSERT_EQ(seenOf(found.schoolmates), nearestByBruteForce(school, fish, true))
            << "fish " << fish;
        ASSERT_EQ(seenOf(found.others), nearestByBruteForce(school, fish, false))
            << "fish " << fish;
    }
}

void expectVectorsEqualPlainCode(const School& school) {
    const Grids grids = school.grids();
    for (std::uint32_t fish = 0; fish < school.view.size(); ++fish) {
        const fish::SpeciesParameters& parameters = school.makeSpeciesParameters(fish);
        const NearestFish vectors = nearestVisible(school.view, grids, parameters, fish);
        const NearestFish plain =
            nearestVisibleReference(school.view, grids.fish, parameters, fish);
        ASSERT_EQ(seenOf(vectors.schoolmates), seenOf(plain.schoolmates)) << "fish " << fish;
        ASSERT_EQ(seenOf(vectors.others), seenOf(plain.others)) << "fish " << fish;
    }
}

const place::Region kWater{{1, -6, -5}, {3, 1.5F, 2}};

TEST(Neighbours, theSearchFindsWhatBruteForceFinds) {
    for (const std::size_t fish : {1U, 2U, 9U, 51U, 700U, 3000U}) {
        SCOPED_TRACE(fish);
        expectVectorsEqualBruteForce(School(7, fish, kWater));
    }
}

TEST(Neighbours, theSearchFindsThemInABaitBall) {
    const place::Region ball{kWater.centre, glm::vec3{0.35F}};  // some 14 000 fish a cubic metre
    expectVectorsEqualBruteForce(School(scatteredSchool(3, 4800, ball), kWater), 7);
}

TEST(Neighbours, theSearchFindsFishThatStrayedOutOfTheWater) {
    const place::Region wider{kWater.centre, kWater.halfExtent * 1.6F};
    expectVectorsEqualBruteForce(School(scatteredSchool(8, 900, wider), kWater));
    const place::Region far{kWater.centre, kWater.halfExtent * 20.0F};
    expectVectorsEqualBruteForce(School(scatteredSchool(8, 900, far), kWater));
}

TEST(Neighbours, theSearchPassesOverFishThatAreAway) {
    School school(11, 800, kWater);
    for (std::size_t fish = 0; fish < 800; fish += 3) school.view.signs[fish] = fish::kAway;
    expectVectorsEqualBruteForce(school);
}

TEST(Neighbours, withoutFishTheGridIsMadeAllTheSame) {
    EXPECT_EQ(School(1, 0, kWater).grids().fish.size(), 0U);
}

TEST(Neighbours, everyInstructionSetFindsWhatPlainCodeFinds) {
    const place::Region ball{kWater.centre, glm::vec3{0.5F}};
    const std::array schools{School(5, 1500, kWater),
                             School(scatteredSchool(6, 1500, ball), kWater)};
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        SCOPED_TRACE(hwy::TargetName(target));
        test::useOnly(target);
        for (const School& school : schools) expectVectorsEqualPlainCode(school);
    }
    test::useOnly(0);
}

// How many fish are looked at together is said by the code that looks, as it was compiled.
TEST(Neighbours, theSearchUsesTheProcessorsVectors) {
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        SCOPED_TRACE(hwy::TargetName(target));
        test::useOnly(target);
        const bool isPlain = target == HWY_SCALAR || target == HWY_EMU128;
        const bool isWide = target <= HWY_AVX3 && target >= HWY_AVX3_DL;
        const std::size_t lanes = isPlain ? 1 : isWide ? 16 : target == HWY_AVX2 ? 8 : 4;
        EXPECT_EQ(nearestVisibleLanes(), lanes);
    }
    test::useOnly(0);
    EXPECT_GE(nearestVisibleLanes(), 4U) << "what is used where nothing is forbidden";
}

TEST(Neighbours, ofEquallyNearFishTheLowerIndexComesFirst) {
    fish::FishView view = scatteredSchool(9, 12, kWater);
    for (std::size_t i = 0; i < 12; ++i) {
        // Eleven at one point, ahead of fish 5.
        view.fish[i].position = {i == 5 ? 0.0F : 0.5F, -6, -5};
        view.fish[i].heading = {1, 0, 0};
    }
    School school(view, kWater);
    school.speciesParameters[0].last = 12;
    std::fill(school.view.kind.begin(), school.view.kind.end(), std::uint8_t{0});
    const NearestFish found =
        nearestVisible(school.view, school.grids(), school.speciesParameters[0], 5);
    EXPECT_EQ(found.schoolmates.fish,
              (std::array<std::uint32_t, kMostNeighbours>{0, 1, 2, 3, 4, 6, 7}));
    expectVectorsEqualBruteForce(school);
}

TEST(Neighbours, allFishAtOnePointFindTheLowestIndices) {
    const place::Region point{kWater.centre, {0, 0, 0}};
    expectVectorsEqualBruteForce(School(scatteredSchool(4, 1000, point), kWater), 11);
}

TEST(Neighbours, equalDistancesOnALatticeAreSettledByIndex) {
    fish::FishView view = scatteredSchool(4, 1000, kWater);
    for (std::size_t i = 0; i < 1000; ++i) {
        const std::size_t layer = i / 100;
        view.fish[i].position =
            kWater.centre + glm::vec3{0.25F * static_cast<float>(i % 10),
                                      0.25F * static_cast<float>(i / 10 % 10) - 1,
                                      0.25F * static_cast<float>(layer) - 1};
    }
    expectVectorsEqualBruteForce(School(view, kWater));
}

TEST(Neighbours, aFishIsBlindThirtyDegreesAboutStraightBehind) {
    const glm::vec3 heading{0, 0, -1};
    EXPECT_TRUE(inFieldOfView(heading, {0, 0, -3}));
    EXPECT_TRUE(inFieldOfView(heading, {1, 0, 0}));
    EXPECT_TRUE(inFieldOfView(heading, {0.515F, 0, 0.857F})) << "31 degrees from behind";
    EXPECT_FALSE(inFieldOfView(heading, {0.485F, 0, 0.875F})) << "29 degrees from behind";
    EXPECT_FALSE(inFieldOfView(heading, {0, 0, 2}));
}

}  // namespace
}  // namespace aquarama::behaviour
