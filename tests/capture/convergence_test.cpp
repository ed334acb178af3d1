// SPDX-License-Identifier: Apache-2.0
// How close the shipped step is to the equations of motion: against a plain Runge-Kutta method, and
// against itself at shorter steps.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "capture/biomechanical_fish.h"
#include "capture/motor_controllers.h"
#include "tests/capture/plain_forces.h"
#include "tests/support/all_species.h"
#include "tests/support/scad.h"

namespace aquarama::capture {
namespace {

using ControlAt = std::function<MotorControl(double seconds)>;

// Tail beat and pectoral fins together, so that every force takes part. The beat grows smoothly.
MotorControl everythingMoves(double seconds) {
    const config::Swim& swim = test::scad().swim;
    const double grown = std::min(1.0, 10 * seconds);
    return {
        .muscles = beatAt(swim, grown * grown * (3 - 2 * grown), swim.medium.beatHertz * seconds),
        .fins = {.left = {.angleRadians = 1.2 + std::sin(9 * seconds)},
                 .right = {.angleRadians = 2.4}},
        .rowing = {},
        .tone = {}};
}

// Both pectoral fins row, each at its own pace, while the tail beats.
MotorControl everythingRows(double seconds) {
    const auto stroke = [&](double hertz, double twist) {
        const double phase = 2 * std::numbers::pi * hertz * seconds;
        const double rate = 2 * std::numbers::pi * hertz;
        return BladeMotion{
            .pose = {1.2, 0.6 * std::sin(phase), twist * std::cos(phase)},
            .rate = {0, 0.6 * rate * std::cos(phase), -twist * rate * std::sin(phase)}};
    };
    MotorControl control = everythingMoves(seconds);
    control.rowing = {.rows = true, .left = stroke(2, 0.9), .right = stroke(3, -0.5)};
    return control;
}

FishState swimmingOff(const BiomechanicalFish& fish) {
    FishState state = stateAtRest(fish);
    for (glm::dvec3& velocity : state.velocities) velocity = {1.5, 0.1, 0};
    return state;
}

// The classical method of fourth order. It is explicit: a step is far below the period of the
// stiffest springs.
void rungeKuttaStep(const BiomechanicalFish& fish,
                    const ControlAt& control,
                    double time,
                    double seconds,
                    FishState& state) {
    struct Rate {
        NodeVectors velocities, accelerations;
    };
    const auto rateAt = [&](const FishState& at, double offset) {
        const PlainForces forces = forcesOn(fish, control(time + offset), at);
        Rate rate{at.velocities, {}};
        for (std::size_t i = 0; i < fish.masses.size(); ++i)
            rate.accelerations.at(i) =
                (forces.springs.at(i) + forces.dampers.at(i) + forces.water.at(i)) /
                fish.masses.at(i);
        return rate;
    };
    const auto moved = [&](const Rate& rate, double by) {
        FishState at = state;
        for (std::size_t i = 0; i < fish.masses.size(); ++i) {
            at.positions.at(i) += by * rate.velocities.at(i);
            at.velocities.at(i) += by * rate.accelerations.at(i);
        }
        return at;
    };
    const Rate a = rateAt(state, 0);
    const Rate b = rateAt(moved(a, seconds / 2), seconds / 2);
    const Rate c = rateAt(moved(b, seconds / 2), seconds / 2);
    const Rate d = rateAt(moved(c, seconds), seconds);
    const auto add = [&](NodeVectors& to, NodeVectors Rate::*of) {
        for (std::size_t i = 0; i < to.size(); ++i)
            to.at(i) += seconds / 6 *
                        ((a.*of).at(i) + 2.0 * ((b.*of).at(i) + (c.*of).at(i)) + (d.*of).at(i));
    };
    add(state.positions, &Rate::velocities);
    add(state.velocities, &Rate::accelerations);
}

// Root mean square over the nodes, body lengths.
double distanceOf(const FishState& a, const FishState& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.positions.size(); ++i) {
        const glm::dvec3 apart = a.positions.at(i) - b.positions.at(i);
        sum += glm::dot(apart, apart);
    }
    return std::sqrt(sum / body::kNodalPoints);
}

class ConvergenceOf : public testing::TestWithParam<MotorControl (*)(double)> {};
INSTANTIATE_TEST_SUITE_P(Controls,
                         ConvergenceOf,
                         testing::Values(everythingMoves, everythingRows),
                         [](const auto& control) {
                             return control.index == 0 ? "tail_and_plates" : "tail_and_rowing";
                         });

TEST_P(ConvergenceOf, isOfSecondOrderTowardsARungeKuttaMethod) {
    const ControlAt control = GetParam();
    const BiomechanicalFish fish = makeBiomechanicalFish(test::scad());
    const double shipped = longestStepSeconds(fish);
    constexpr int kSteps = 180;  // a quarter of a second, most of a beat
    constexpr int kFiner = 64;
    FishState exact = swimmingOff(fish);
    for (int i = 0; i < kSteps * kFiner; ++i)
        rungeKuttaStep(fish, control, i * shipped / kFiner, shipped / kFiner, exact);
    const auto errorAt = [&](int parts) {
        FishState state = swimmingOff(fish);
        for (int i = 0; i < kSteps * parts; ++i)
            step(fish, control((i + 0.5) * shipped / parts), shipped / parts, state);
        return distanceOf(state, exact);
    };
    const std::array errors{errorAt(1), errorAt(2), errorAt(4)};
    std::printf(
        "error after 0.25 s at h, h/2, h/4: %.2e %.2e %.2e BL\n", errors[0], errors[1], errors[2]);
    EXPECT_LT(errors[0], 1e-4);
    if (control(0).rowing.rows) {
        // The drag of a fin has a kink where the fin stops in the water.
        EXPECT_GT(errors[0] / errors[1], 3);
        EXPECT_GT(errors[1] / errors[2], 3);
        return;
    }
    EXPECT_NEAR(std::log2(errors[0] / errors[1]), 2, 0.3);
    EXPECT_NEAR(std::log2(errors[1] / errors[2]), 2, 0.3);
}

// Of a beat.
struct Swum {
    double stride = 0;  // of the centre of mass, body lengths
    double tail = 0;    // peak to peak across the course, body lengths
};

// The thirteenth beat after a flying start, at the fewest whole steps in a 64th of the beat that
// are not longer than the shipped one, each in so many parts.
Swum swum(const config::Species& species, const config::Gait& gait, int parts) {
    constexpr int kPhases = 64;
    const BiomechanicalFish fish = makeBiomechanicalFish(species);
    const double phase = 1 / gait.beatHertz / kPhases;
    const int steps = parts * static_cast<int>(std::ceil(phase / longestStepSeconds(fish) - 1e-9));
    FishState state = stateAtRest(fish);
    for (glm::dvec3& velocity : state.velocities) velocity.x = 0.6 * gait.beatHertz;
    int done = 0;
    const auto advancePhase = [&] {
        for (int i = 0; i < steps; ++i, ++done)
            step(fish,
                 {.muscles = beatAt(species.swim, gait.gain, (done + 0.5) / (steps * kPhases)),
                  .fins = {},
                  .rowing = {},
                  .tone = {}},
                 phase / steps,
                 state);
    };
    const auto centre = [&] {
        glm::dvec3 sum{};
        for (std::size_t i = 0; i < fish.masses.size(); ++i)
            sum += fish.masses.at(i) * state.positions.at(i);
        return sum;
    };
    for (int i = 0; i < 12 * kPhases; ++i) advancePhase();
    const glm::dvec3 from = centre();
    std::array<glm::dvec3, kPhases> tail;
    for (glm::dvec3& at : tail) {
        advancePhase();
        at = (state.positions[21] + state.positions[22]) / 2.0;
    }
    const glm::dvec3 way = centre() - from;
    const glm::dvec3 across = glm::normalize(glm::cross(way, glm::dvec3(0, 1, 0)));
    const auto [least, most] =
        std::ranges::minmax(tail, {}, [&](const glm::dvec3& at) { return glm::dot(at, across); });
    return {glm::length(way), glm::dot(most - least, across)};
}

// Prints the table of docs/motion.md. Speed is stride times beat, so it changes by the same share.
TEST(Convergence, aQuarterOfTheShippedStepChangesNoFigureOfAnySpecies) {
    std::printf(
        "| species | beat, Hz | stride, L | at a quarter of the step | tail, L | at a "
        "quarter of the step |\n|---|---|---|---|---|---|\n");
    for (const config::Species& species : test::allSpecies())
        for (const config::Gait& gait :
             {species.swim.slow, species.swim.medium, species.swim.fast}) {
            if (gait.gain == 0) continue;  // it is rowed
            const Swum shipped = swum(species, gait, 1);
            const Swum fine = swum(species, gait, 4);
            const double stride = fine.stride / shipped.stride - 1;
            const double tail = fine.tail / shipped.tail - 1;
            std::printf("| %s | %.2f | %.4f | %+.4f %% | %.4f | %+.4f %% |\n",
                        species.name.c_str(),
                        gait.beatHertz,
                        shipped.stride,
                        100 * stride,
                        shipped.tail,
                        100 * tail);
            EXPECT_LT(std::abs(stride), 5e-4) << species.name << " at " << gait.beatHertz << " Hz";
            EXPECT_LT(std::abs(tail), 5e-4) << species.name << " at " << gait.beatHertz << " Hz";
        }
}

TEST(Convergence, ofTheStrideIsOfSecondOrder) {
    const config::Species& scad = test::scad();
    const auto strideAt = [&](int parts) { return swum(scad, scad.swim.fast, parts).stride; };
    const std::array strides{strideAt(1), strideAt(2), strideAt(4)};
    EXPECT_NEAR(std::log2((strides[0] - strides[1]) / (strides[1] - strides[2])), 2, 0.3);
}

}  // namespace
}  // namespace aquarama::capture
