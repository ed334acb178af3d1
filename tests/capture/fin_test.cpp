// SPDX-License-Identifier: Apache-2.0
// What pushes a fish beside the faces of its body: pectoral fins, and lift.
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "capture/biomechanical_fish.h"
#include "capture/dynamics.h"
#include "tests/capture/disturbed.h"
#include "tests/support/scad.h"

namespace aquarama::capture {
namespace {

// Short enough that the velocity at its end is that at its start.
constexpr double kInstant = 1e-6;

BiomechanicalFish finsAlone() {
    BiomechanicalFish fish = inVacuum();
    fish.finDrag = makeBiomechanicalFish(test::scad()).finDrag;
    return fish;
}

// On the whole fish, which weighs 1, as it begins to swim forward at this speed.
glm::dvec3 forceOf(const FinPlates& fins, double speed) {
    const BiomechanicalFish fish = finsAlone();
    FishState state = stateAtRest(fish);
    for (glm::dvec3& velocity : state.velocities) velocity = {speed, 0, 0};
    step(fish, {.muscles = {}, .fins = fins, .rowing = {}, .tone = {}}, kInstant, state);
    glm::dvec3 momentum{};
    for (std::size_t i = 0; i < state.velocities.size(); ++i)
        momentum += fish.masses.at(i) * state.velocities.at(i);
    return (momentum - glm::dvec3(speed, 0, 0)) / kInstant;
}

FinPlates both(const FinPlate& fin) {
    return {.left = fin, .right = fin};
}

TEST(PectoralFins, pushAsTusLawSays) {
    const double drag = finsAlone().finDrag;
    for (const double angle : {0.8, 1.2, 1.9, 2.6}) {
        const glm::dvec3 normal{std::cos(angle), std::sin(angle), 0};
        const glm::dvec3 law = -2 * drag * (2 * normal.x) * normal;
        const glm::dvec3 force = forceOf(both({.angleRadians = angle}), 2);
        EXPECT_LT(glm::distance(force, law), 1e-3 * glm::length(law)) << angle;
    }
}

TEST(PectoralFins, letTheStreamPassWhenFlat) {
    EXPECT_LT(glm::length(forceOf({}, 2)), 1e-6);
}

TEST(PectoralFins, rollTheFishTowardsTheFinThatStandsLower) {
    const BiomechanicalFish fish = makeBiomechanicalFish(test::scad());
    FishState state = stateAtRest(fish);
    for (glm::dvec3& velocity : state.velocities) velocity = {2, 0, 0};
    const FinPlates leftUp{.left = {.angleRadians = 2}, .right = {.angleRadians = 1.14}};
    for (int i = 0; i < 100; ++i)
        step(fish,
             {.muscles = {}, .fins = leftUp, .rowing = {}, .tone = {}},
             longestStepSeconds(fish),
             state);
    EXPECT_LT(frameOf(state.positions).worldFromBody[2].y, -0.1) << "right side down";
}

TEST(Lift, bearsTheWholeFishUp) {
    BiomechanicalFish fish = inVacuum();
    for (std::size_t i = 0; i < fish.lifts.size(); ++i) fish.lifts.at(i) = 0.3 * fish.masses.at(i);
    FishState state = stateAtRest(fish);
    for (int i = 0; i < 720; ++i) step(fish, {}, 1.0 / 720, state);
    for (const glm::dvec3& velocity : state.velocities)
        EXPECT_LT(glm::distance(velocity, glm::dvec3(0, 0.3, 0)), 1e-9) << "after a second";
}

TEST(Lift, rightsAFishThatFloatsBackUp) {
    BiomechanicalFish fish = makeBiomechanicalFish(test::scad());
    for (const std::size_t dorsal : {5U, 6U}) fish.lifts.at(dorsal) = 0.1;
    for (const std::size_t ventral : {7U, 8U}) fish.lifts.at(ventral) = -0.1;
    FishState state = stateAtRest(fish);
    for (glm::dvec3& x : state.positions) {  // on its left side, nearly
        const double angle = 1.4;
        x = {x.x,
             std::cos(angle) * x.y - std::sin(angle) * x.z,
             std::sin(angle) * x.y + std::cos(angle) * x.z};
    }
    EXPECT_LT(frameOf(state.positions).worldFromBody[1].y, 0.2);
    for (int i = 0; i < 20 * 720; ++i) step(fish, {}, 1.0 / 720, state);
    EXPECT_GT(frameOf(state.positions).worldFromBody[1].y, 0.996) << "within 5 degrees of upright";
}

}  // namespace
}  // namespace aquarama::capture
