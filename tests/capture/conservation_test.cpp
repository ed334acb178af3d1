// SPDX-License-Identifier: Apache-2.0
// What must neither appear nor vanish: momentum and energy.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "capture/biomechanical_fish.h"
#include "capture/motor_controllers.h"
#include "tests/capture/disturbed.h"
#include "tests/capture/plain_forces.h"
#include "tests/support/all_species.h"
#include "tests/support/scad.h"

namespace aquarama::capture {
namespace {

glm::dvec3 angularMomentumOf(const BiomechanicalFish& fish, const FishState& state) {
    glm::dvec3 momentum{};
    for (std::size_t i = 0; i < state.velocities.size(); ++i)
        momentum += fish.masses.at(i) * glm::cross(state.positions.at(i), state.velocities.at(i));
    return momentum;
}

double energyOf(const BiomechanicalFish& fish, const FishState& state) {
    return kineticEnergyOf(fish, state) + elasticEnergyOf(fish, {}, state);
}

MotorControl swimming(double seconds) {
    return {.muscles = beatAt(test::scad().swim, 1, test::scad().swim.medium.beatHertz * seconds),
            .fins = {},
            .rowing = {},
            .tone = {}};
}

TEST(Momentum, isKeptInAVacuumToRoundingWhateverTheMusclesDo) {
    const BiomechanicalFish fish = inVacuum();
    FishState state = disturbed(fish);
    const glm::dvec3 before = momentumOf(fish, state);
    for (int i = 0; i < 500; ++i)
        step(fish, swimming(i * longestStepSeconds(fish)), longestStepSeconds(fish), state);
    EXPECT_LT(glm::distance(momentumOf(fish, state), before), 1e-11);
}

// Relative change over 500 steps of a fish in a vacuum that beats its tail.
double changeOfAngularMomentum(const BiomechanicalFish& fish, FishState state) {
    const glm::dvec3 before = angularMomentumOf(fish, state);
    const double seconds = longestStepSeconds(fish);
    for (int i = 0; i < 500; ++i) step(fish, swimming(i * seconds), seconds, state);
    return glm::distance(angularMomentumOf(fish, state), before) / glm::length(before);
}

// The rule keeps it exactly. What changes it is the rest that Newton's method leaves.
TEST(AngularMomentum, isKeptInAVacuumWhateverTheMusclesDo) {
    const BiomechanicalFish fish = inVacuum();
    const double change = changeOfAngularMomentum(fish, disturbed(fish));
    std::printf("change of the angular momentum: %.4f %%\n", 100 * change);
    EXPECT_LT(change, 1e-4);
    FishState spinning = stateAtRest(fish);
    for (std::size_t i = 0; i < spinning.velocities.size(); ++i)
        spinning.velocities.at(i) = glm::cross(glm::dvec3(0.2, 1, 0.1), spinning.positions.at(i));
    EXPECT_LT(changeOfAngularMomentum(fish, spinning), 1e-4);
}

// The rule keeps it exactly. What changes it is the rest that Newton's method leaves.
TEST(Energy, isKeptWhereNothingDamps) {
    BiomechanicalFish fish = inVacuum();
    fish.damping = 0;
    FishState state = disturbed(fish);
    const double before = energyOf(fish, state);
    for (int i = 0; i < 3000; ++i) {
        step(fish, {}, longestStepSeconds(fish), state);
        ASSERT_NEAR(energyOf(fish, state), before, 0.01 * before) << "step " << i;
    }
}

TEST(Energy, neverGrowsInWaterHoweverTheFinsStand) {
    const BiomechanicalFish fish = makeBiomechanicalFish(test::scad());
    const FinPlates braking{.left = {.angleRadians = 0.9}, .right = {.angleRadians = 3}};
    for (const double seconds : {longestStepSeconds(fish), 1.0 / 60, 1.0 / 30})
        for (const FinPlates& fins : {FinPlates{}, braking}) {
            FishState state = disturbed(fish);
            double energy = energyOf(fish, state);
            for (int i = 0; i < 300; ++i) {
                step(fish, {.muscles = {}, .fins = fins, .rowing = {}, .tone = {}}, seconds, state);
                const double now = energyOf(fish, state);
                ASSERT_LE(now, energy * (1 + 1e-12)) << "step " << i << " of " << seconds << " s";
                energy = now;
            }
        }
}

// Where the energy of some beats goes, in body lengths and fish masses.
struct EnergyBalance {
    double gained = 0;   // kinetic and elastic energy at the end, less that at the beginning
    double muscles = 0;  // work of the muscles as they change rest lengths
    double tissue = 0;   // taken by the dampers
    double water = 0;    // taken by drag and fins
    [[nodiscard]] double missing() const { return gained - muscles + tissue + water; }
};

// One step with given muscles. A muscle changes its rest length at the beginning of a step, which
// is work; losses are forces times velocities at the middle of the step.
void balanceStep(const BiomechanicalFish& fish,
                 const MuscleActivation& before,
                 const MuscleActivation& now,
                 FishState& state,
                 EnergyBalance& balance) {
    const double seconds = longestStepSeconds(fish);
    balance.muscles += elasticEnergyOf(fish, now, state) - elasticEnergyOf(fish, before, state);
    FishState middle = state;
    step(fish, {.muscles = now, .fins = {}, .rowing = {}, .tone = {}}, seconds, state);
    for (std::size_t i = 0; i < middle.positions.size(); ++i) {
        middle.velocities.at(i) = (state.positions.at(i) - middle.positions.at(i)) / seconds;
        middle.positions.at(i) += seconds / 2 * middle.velocities.at(i);
    }
    const PlainForces forces =
        forcesOn(fish, {.muscles = now, .fins = {}, .rowing = {}, .tone = {}}, middle);
    balance.tissue -= seconds * powerOf(forces.dampers, middle.velocities);
    balance.water -= seconds * powerOf(forces.water, middle.velocities);
}

// Over four beats, after twelve from a flying start.
EnergyBalance balanceOf(const config::Species& species, const config::Gait& gait) {
    const BiomechanicalFish fish = makeBiomechanicalFish(species);
    const auto stepsInABeat =
        static_cast<int>(std::ceil(1 / (gait.beatHertz * longestStepSeconds(fish))));
    const auto musclesAt = [&](int i) {
        return beatAt(
            species.swim, gait.gain, gait.beatHertz * (i + 0.5) * longestStepSeconds(fish));
    };
    FishState state = stateAtRest(fish);
    for (glm::dvec3& velocity : state.velocities) velocity.x = 0.6 * gait.beatHertz;
    int i = 0;
    for (; i < 12 * stepsInABeat; ++i)
        step(fish,
             {.muscles = musclesAt(i), .fins = {}, .rowing = {}, .tone = {}},
             longestStepSeconds(fish),
             state);
    const auto energyNow = [&] {
        return kineticEnergyOf(fish, state) + elasticEnergyOf(fish, musclesAt(i - 1), state);
    };
    EnergyBalance balance;
    balance.gained = -energyNow();
    for (; i < 16 * stepsInABeat; ++i)
        balanceStep(fish, musclesAt(i - 1), musclesAt(i), state, balance);
    balance.gained += energyNow();
    return balance;
}

TEST(Energy, ofTheMusclesGoesToTissueAndWaterInEveryGaitOfEverySpecies) {
    double most = 0;
    for (const config::Species& species : test::allSpecies())
        for (const config::Gait& gait :
             {species.swim.slow, species.swim.medium, species.swim.fast}) {
            if (gait.gain == 0) continue;  // it is rowed, by fins without muscles
            const EnergyBalance balance = balanceOf(species, gait);
            EXPECT_GT(balance.muscles, 0);
            EXPECT_GT(balance.tissue, 0);
            EXPECT_GT(balance.water, 0);
            const double missing = std::abs(balance.missing()) / balance.muscles;
            EXPECT_LT(missing, 1e-3) << species.name << " at " << gait.beatHertz << " Hz";
            most = std::max(most, missing);
        }
    std::printf("missing of the muscles' work at most: %.4f %%\n", 100 * most);
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
