// SPDX-License-Identifier: Apache-2.0
#include "master/capture/dynamics/anatomy.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "master/capture/dynamics/biomechanical_fish.h"
#include "tests/master/capture/dynamics/dense.h"
#include "tests/support/scad.h"

namespace aquarama {
namespace {

// How many independent ways of changing shape the units that pass resist.
template <class Passes>
std::size_t rigidityRank(Passes passes) {
    const NodeVectors x = makeBiomechanicalFish(scad()).restPositions;
    DenseMatrix rigidity;
    for (const Unit& unit : anatomy().units) {
        if (!passes(unit)) continue;
        const glm::dvec3 u = glm::normalize(x.at(unit.second) - x.at(unit.first));
        std::vector<double> row(3 * kNodalPoints);
        for (int p = 0; p < 3; ++p) {
            row.at(static_cast<std::size_t>(3 * unit.first + p)) = -u[p];
            row.at(static_cast<std::size_t>(3 * unit.second + p)) = u[p];
        }
        rigidity.push_back(std::move(row));
    }
    return reduce(rigidity, 3 * kNodalPoints);
}

constexpr std::size_t kShapes = 3 * kNodalPoints - 6;  // all motions but translation and rotation

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
    EXPECT_EQ(rigidityRank([](const Unit&) { return true; }), kShapes);
    EXPECT_EQ(rigidityRank([](const Unit& unit) { return unit.side == Side::Neither; }), kShapes);
}

TEST(Anatomy, wouldBeAMechanismWithoutStruts) {
    EXPECT_LT(rigidityRank([](const Unit& unit) { return unit.kind != UnitKind::Cross; }), kShapes);
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
    const NodeVectors x = makeBiomechanicalFish(scad()).restPositions;
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
}  // namespace aquarama
