// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "capture/biomechanical_fish.h"
#include "common/base/log.h"
#include "tests/support/scad.h"

namespace aquarama::capture {
namespace {

template <class Passes>
int freeWithOnly(Passes passes) {
    std::vector<Unit> units;
    std::ranges::copy_if(anatomy().units, std::back_inserter(units), passes);
    return freeShapeChanges(makeBiomechanicalFish(test::scad()).restPositions, units);
}

TEST(Anatomy, hasThePapersNumbers) {
    std::map<UnitKind, int> count;
    std::set<std::pair<int, int>> pairs;
    for (const Unit& unit : anatomy().units) {
        ++count[unit.kind];
        pairs.insert({unit.first, unit.second});
        EXPECT_LT(unit.first, unit.second);
        EXPECT_LE(unit.second - unit.first, 7) << "the system's half-bandwidth";
    }
    EXPECT_EQ(pairs.size(), std::size_t{kUnits});
    EXPECT_EQ(count[UnitKind::Normal], 33);
    EXPECT_EQ(count[UnitKind::Cross], 46);
    const int muscles =
        count[UnitKind::FrontMuscle] + count[UnitKind::MiddleMuscle] + count[UnitKind::BackMuscle];
    EXPECT_EQ(muscles, kMuscles);
}

TEST(Anatomy, holdsItsShapeEvenWithoutMuscles) {
    EXPECT_EQ(freeWithOnly([](const Unit&) { return true; }), 0);
    EXPECT_EQ(freeWithOnly([](const Unit& unit) { return unit.side == Side::Neither; }), 0);
}

TEST(Anatomy, wouldBeAMechanismWithoutStruts) {
    EXPECT_GT(freeWithOnly([](const Unit& unit) { return unit.kind != UnitKind::Cross; }), 0);
}

TEST(Anatomy, losesAWayToHoldItsShapeWithEachUnitThatOneNeeds) {
    const auto holdsNose = [](const Unit& unit) { return unit.first == 0; };
    const auto but = [&](int spared) {
        return [&holdsNose, spared](const Unit& unit) {
            return !holdsNose(unit) || unit.second > spared;
        };
    };
    EXPECT_EQ(freeWithOnly(but(1)), 0) << "three of its four units hold the nose";
    EXPECT_EQ(freeWithOnly(but(2)), 1);
    EXPECT_EQ(freeWithOnly(but(4)), 3);
}

TEST(Anatomy, refusesASkeletonThatIsNotRigid) {
    config::Species flat = test::scad();
    for (config::SkeletonRing& ring : flat.skeleton.rings) ring.halfWidth = 0;
    const auto make = [&] { return makeBiomechanicalFish(flat); };
    EXPECT_THAT(make,
                testing::ThrowsMessage<Error>(testing::AllOf(testing::HasSubstr("bigeye_scad"),
                                                             testing::HasSubstr("not rigid"),
                                                             testing::HasSubstr("a width"))));
}

TEST(Anatomy, isItsOwnMirrorImageBothWays) {
    const std::set<Unit> all(anatomy().units.begin(), anatomy().units.end());
    const auto image = [](const Unit& unit, int (*partner)(int), Side side) {
        const auto a = static_cast<std::uint8_t>(partner(unit.first));
        const auto b = static_cast<std::uint8_t>(partner(unit.second));
        return Unit{std::min(a, b), std::max(a, b), unit.kind, side};
    };
    for (const Unit& unit : anatomy().units) {
        const Side other = unit.side == Side::Left    ? Side::Right
                           : unit.side == Side::Right ? Side::Left
                                                      : Side::Neither;
        EXPECT_TRUE(all.contains(image(unit, mirroredLeftRight, other)));
        EXPECT_TRUE(all.contains(image(unit, mirroredTopBottom, unit.side)));
    }
}

TEST(Anatomy, facesCloseTheFishAndLookOutward) {
    const NodeVectors x = makeBiomechanicalFish(test::scad()).restPositions;
    glm::dvec3 sum{};
    double volume = 0;
    for (const DragFace& face : anatomy().faces) {
        const auto [a, b, c] = face.nodes;
        sum += face.weight * glm::cross(x[b] - x[a], x[c] - x[a]);
        volume += face.weight * glm::dot(x[a], glm::cross(x[b], x[c])) / 6;
    }
    EXPECT_LT(glm::length(sum), 1e-12);
    EXPECT_GT(volume, 0);
}

}  // namespace
}  // namespace aquarama::capture
