// SPDX-License-Identifier: Apache-2.0
#include "capture/dynamics.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include "capture/biomechanical_fish.h"
#include "capture/motor_controllers.h"
#include "tests/capture/dense.h"
#include "tests/capture/disturbed.h"
#include "tests/support/all_species.h"
#include "tests/support/instruction_sets.h"
#include "tests/support/scad.h"

namespace aquarama::capture {
namespace {

void addBlock(DenseMatrix& matrix, int rowNode, int columnNode, const glm::dmat3& block) {
    for (int p = 0; p < 3; ++p)
        for (int q = 0; q < 3; ++q)
            matrix.at(3 * static_cast<std::size_t>(rowNode) + static_cast<std::size_t>(p))
                .at(3 * static_cast<std::size_t>(columnNode) + static_cast<std::size_t>(q)) +=
                block[p][q];
}

TEST(EnvelopeSystem, solvesWhatADenseSolverSolves) {
    constexpr std::size_t kSize = EnvelopeSystem::kUnknowns;
    EnvelopeSystem system;
    DenseMatrix dense(kSize, std::vector<double>(kSize));
    std::vector<double> right;
    for (int i = 0; i < body::kNodalPoints; ++i) {
        system.addToDiagonal(i, 1 + 0.1 * i);
        addBlock(dense, i, i, glm::dmat3(1 + 0.1 * i));
        const glm::dvec3 value{std::sin(i), std::cos(i), 0.5};
        system.addToRightSide(i, value);
        right.insert(right.end(), {value.x, value.y, value.z});
    }
    for (const Unit& unit : anatomy().units) {
        const glm::dvec3 u = glm::normalize(
            glm::dvec3(std::sin(unit.first), std::cos(unit.second), std::sin(unit.second)));
        const glm::dmat3 block = glm::outerProduct(u, u) + glm::dmat3(0.1);
        system.addDiagonalBlock(unit.first, block);
        system.addDiagonalBlock(unit.second, block);
        system.addOffDiagonalBlock(unit.first, unit.second, -block);
        addBlock(dense, unit.first, unit.first, block);
        addBlock(dense, unit.second, unit.second, block);
        addBlock(dense, unit.first, unit.second, -block);
        addBlock(dense, unit.second, unit.first, -block);
    }
    system.solve();
    const std::vector<double> expected = solveDense(dense, right);
    for (int i = 0; i < body::kNodalPoints; ++i)
        for (int p = 0; p < 3; ++p)
            EXPECT_NEAR(system.solution(i)[p],
                        expected.at(3 * static_cast<std::size_t>(i) + static_cast<std::size_t>(p)),
                        1e-12);
}

TEST(Dynamics, aFishAtRestStaysAtRest) {
    const BiomechanicalFish fish = makeBiomechanicalFish(test::scad());
    FishState state = stateAtRest(fish);
    for (int i = 0; i < 100; ++i) step(fish, {}, longestStepSeconds(fish), state);
    for (std::size_t i = 0; i < state.positions.size(); ++i)
        EXPECT_LT(glm::distance(state.positions.at(i), fish.restPositions.at(i)), 1e-12);
}

TEST(Dynamics, waterOnlyEverSlowsAStiffFish) {
    const BiomechanicalFish fish = makeBiomechanicalFish(test::scad());
    FishState state = stateAtRest(fish);
    for (glm::dvec3& velocity : state.velocities) velocity = {2, 0, 0};
    double speed = momentumOf(fish, state).x;
    for (int i = 0; i < 200; ++i) {
        step(fish, {}, longestStepSeconds(fish), state);
        const double now = momentumOf(fish, state).x;
        ASSERT_LT(now, speed);
        ASSERT_GT(now, 0);
        speed = now;
    }
}

TEST(Dynamics, exchangedMusclesSwimTheMirroredPathInEverySpecies) {
    for (const config::Species& species : test::allSpecies()) {
        const BiomechanicalFish fish = makeBiomechanicalFish(species);
        FishState left = stateAtRest(fish);
        FishState right = stateAtRest(fish);
        for (int i = 0; i < 600; ++i) {
            const double seconds = i * longestStepSeconds(fish);
            const MuscleActivation muscles =
                mix(beatAt(species.swim, 1, species.swim.medium.beatHertz * seconds),
                    bendLeft(species.turn.gradual, seconds * fish.timeScale),
                    std::min(1.0, seconds));
            step(fish,
                 {.muscles = muscles, .fins = {}, .rowing = {}, .tone = {}},
                 longestStepSeconds(fish),
                 left);
            step(fish,
                 {.muscles = mirrored(muscles), .fins = {}, .rowing = {}, .tone = {}},
                 longestStepSeconds(fish),
                 right);
        }
        for (int i = 0; i < body::kNodalPoints; ++i) {
            const glm::dvec3 image =
                glm::dvec3(1, 1, -1) *
                right.positions.at(static_cast<std::size_t>(mirroredLeftRight(i)));
            EXPECT_LT(glm::distance(left.positions.at(static_cast<std::size_t>(i)), image), 1e-9)
                << species.name;
        }
    }
}

TEST(Dynamics, everyInstructionSetSwimsTheSamePath) {
    const BiomechanicalFish fish = makeBiomechanicalFish(test::scad());
    std::optional<FishState> first;
    for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
        test::useOnly(target);
        FishState state = stateAtRest(fish);
        for (int i = 0; i < 500; ++i) {
            const double seconds = i * longestStepSeconds(fish);
            const double beat = test::scad().swim.fast.beatHertz;
            step(fish,
                 {.muscles = beatAt(test::scad().swim, 1, beat * seconds),
                  .fins = {},
                  .rowing = {},
                  .tone = {}},
                 longestStepSeconds(fish),
                 state);
        }
        if (!first) first = state;
        EXPECT_EQ(state.positions, first->positions) << hwy::TargetName(target);
        EXPECT_EQ(state.velocities, first->velocities) << hwy::TargetName(target);
    }
    test::useOnly(0);
}

TEST(Dynamics, swimsInAPlane) {
    const BiomechanicalFish fish = makeBiomechanicalFish(test::scad());
    FishState state = stateAtRest(fish);
    for (int i = 0; i < 5000; ++i)
        step(fish,
             {.muscles = beatAt(test::scad().swim,
                                1,
                                test::scad().swim.fast.beatHertz * i * longestStepSeconds(fish)),
              .fins = {},
              .rowing = {},
              .tone = {}},
             longestStepSeconds(fish),
             state);
    for (int i = 0; i < body::kNodalPoints; ++i) {
        const double height = state.positions.at(static_cast<std::size_t>(i)).y;
        const double image = state.positions.at(static_cast<std::size_t>(mirroredTopBottom(i))).y;
        EXPECT_NEAR(height, -image, 1e-9);
    }
}

TEST(BodyFrame, isOrthonormalAndPointsForwardUpAndRight) {
    const BiomechanicalFish fish = makeBiomechanicalFish(test::scad());
    const PoseFrame rest = frameOf(fish.restPositions);
    EXPECT_LT(glm::distance(rest.worldFromBody[0], glm::dvec3(1, 0, 0)), 1e-12);
    EXPECT_LT(glm::distance(rest.worldFromBody[1], glm::dvec3(0, 1, 0)), 1e-12);
    EXPECT_LT(glm::distance(rest.worldFromBody[2], glm::dvec3(0, 0, 1)), 1e-12);
    const PoseFrame bent = frameOf(disturbed(fish).positions);
    const glm::dmat3 square = glm::transpose(bent.worldFromBody) * bent.worldFromBody;
    for (int p = 0; p < 3; ++p)
        for (int q = 0; q < 3; ++q) EXPECT_NEAR(square[p][q], p == q ? 1 : 0, 1e-12);
    EXPECT_GT(glm::determinant(bent.worldFromBody), 0);
}

// Eq. 1 to 3 and 8 on numbers that can be checked by hand: the nose is off to the left and up, and
// the upper edge of ring 2 leans otherwise than the lower one. No other node counts.
TEST(BodyFrame, isTakenFromTheNoseAndFromBothEdgesOfRing2) {
    NodeVectors bent = disturbed(makeBiomechanicalFish(test::scad())).positions;
    bent[0] = {0.40, 0.05, -0.10};
    bent[5] = {0.01, 0.10, -0.04};
    bent[6] = {0.01, 0.12, 0.04};
    bent[7] = {-0.01, -0.09, 0.05};
    bent[8] = {-0.01, -0.13, -0.05};
    // The edges add up to (0, 1, 3) times 0.06, the nose is at (8, 1, -2) / 20.
    const glm::dmat3 known{glm::dvec3(8, 1, -2) / std::sqrt(69.0),
                           glm::dvec3(-5, 24, -8) / std::sqrt(665.0),
                           glm::dvec3(40, 74, 197) / std::sqrt(45885.0)};
    const glm::dmat3 turn =
        glm::mat3_cast(glm::normalize(glm::dquat(0.5, glm::dvec3(-0.3, 0.7, 0.4))));
    const glm::dvec3 way{4, -3, 2};
    NodeVectors moved{};
    for (std::size_t i = 0; i < bent.size(); ++i) moved.at(i) = way + turn * bent.at(i);
    const PoseFrame frame = frameOf(moved);
    EXPECT_LT(glm::distance(frame.origin, way), 1e-12);
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_LT(glm::distance(frame.worldFromBody[axis], turn * known[axis]), 1e-12)
            << "axis " << axis;
    const NodeVectors inside = inBodyFrame(moved);
    EXPECT_LT(glm::distance(inside[0], glm::dvec3(std::sqrt(69.0) / 20, 0, 0)), 1e-12);
    for (std::size_t i = 0; i < bent.size(); ++i)
        EXPECT_LT(glm::distance(inside.at(i), glm::transpose(known) * bent.at(i)), 1e-12)
            << "node " << i;
}

}  // namespace
}  // namespace aquarama::capture
