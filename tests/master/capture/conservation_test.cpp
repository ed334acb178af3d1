// SPDX-License-Identifier: Apache-2.0
// What must neither appear nor vanish: momentum and energy.
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "master/capture/biomechanical_fish.h"
#include "master/capture/motor_controllers.h"
#include "tests/master/capture/disturbed.h"
#include "tests/support/scad.h"

namespace aquarama::capture {
namespace {

glm::dvec3 momentumOf(const BiomechanicalFish& fish, const FishState& state) {
    glm::dvec3 momentum{};
    for (std::size_t i = 0; i < state.velocities.size(); ++i)
        momentum += fish.masses.at(i) * state.velocities.at(i);
    return momentum;
}

glm::dvec3 angularMomentumOf(const BiomechanicalFish& fish, const FishState& state) {
    glm::dvec3 momentum{};
    for (std::size_t i = 0; i < state.velocities.size(); ++i)
        momentum += fish.masses.at(i) * glm::cross(state.positions.at(i), state.velocities.at(i));
    return momentum;
}

double energyOf(const BiomechanicalFish& fish, const FishState& state) {
    double energy = 0;
    for (std::size_t i = 0; i < state.velocities.size(); ++i)
        energy += fish.masses.at(i) * glm::dot(state.velocities.at(i), state.velocities.at(i)) / 2;
    for (const Spring& spring : fish.springs) {
        const double stretch =
            glm::distance(state.positions.at(spring.first), state.positions.at(spring.second)) -
            spring.restLength;
        energy += spring.stiffness * stretch * stretch / 2;
    }
    return energy;
}

MotorControl swimming(double seconds) {
    return {.muscles = beatAt(test::scad().swim, 1, test::scad().swim.medium.beatHertz * seconds),
            .fins = {}};
}

void expectEnergyNeverGrows(const BiomechanicalFish& fish, const MotorControl& control) {
    // Long steps too: the scheme is stable at any.
    for (const double seconds : {longestStepSeconds(fish), 1.0 / 60, 1.0 / 30}) {
        FishState state = disturbed(fish);
        double energy = energyOf(fish, state);
        for (int i = 0; i < 300; ++i) {
            step(fish, control, seconds, state);
            const double now = energyOf(fish, state);
            ASSERT_LE(now, energy * (1 + 1e-12)) << "step " << i << " of " << seconds << " s";
            energy = now;
        }
    }
}

TEST(Momentum, isKeptInAVacuumToRoundingWhateverTheMusclesDo) {
    const BiomechanicalFish fish = inVacuum();
    FishState state = disturbed(fish);
    const glm::dvec3 before = momentumOf(fish, state);
    for (int i = 0; i < 500; ++i)
        step(fish, swimming(i * longestStepSeconds(fish)), longestStepSeconds(fish), state);
    EXPECT_LT(glm::distance(momentumOf(fish, state), before), 1e-11);
}

// Forces taken along the springs as they stood before the step turn the fish a little: an error of
// the scheme, of first order in the step, and none of the model.
TEST(AngularMomentum, isKeptInAVacuumAsTheStepGoesToZero) {
    const BiomechanicalFish fish = inVacuum();
    const auto lossAt = [&](int fineness) {
        FishState state = disturbed(fish);
        const glm::dvec3 before = angularMomentumOf(fish, state);
        const double seconds = longestStepSeconds(fish) / fineness;
        for (int i = 0; i < 100 * fineness; ++i) step(fish, swimming(i * seconds), seconds, state);
        return glm::distance(angularMomentumOf(fish, state), before) / glm::length(before);
    };
    const double coarse = lossAt(1);
    const double fine = lossAt(8);
    EXPECT_LT(fine, 0.05);
    EXPECT_NEAR(coarse / fine, 8, 2);
}

TEST(Energy, neverGrowsWithoutMusclesEvenWhereNothingDamps) {
    BiomechanicalFish fish = inVacuum();
    fish.damping = 0;
    expectEnergyNeverGrows(fish, {});
}

TEST(Energy, neverGrowsInWaterHoweverTheFinsStand) {
    const BiomechanicalFish fish = makeBiomechanicalFish(test::scad());
    expectEnergyNeverGrows(fish, {});
    expectEnergyNeverGrows(
        fish,
        {.muscles = {}, .fins = {.left = {.angleRadians = 0.9}, .right = {.angleRadians = 3}}});
}

TEST(Energy, goesToTheWater) {
    const BiomechanicalFish fish = makeBiomechanicalFish(test::scad());
    FishState state = disturbed(fish);
    const double before = energyOf(fish, state);
    for (int i = 0; i < 1000; ++i) step(fish, {}, longestStepSeconds(fish), state);
    EXPECT_LT(energyOf(fish, state), 0.01 * before);
}

}  // namespace
}  // namespace aquarama::capture
