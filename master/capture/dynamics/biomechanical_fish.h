// SPDX-License-Identifier: Apache-2.0
// The biomechanical fish as plain data, and one step of its dynamics. Units: body lengths, the
// fish's mass, seconds.
#pragma once

#include <array>
#include <cstdint>
#include <numbers>

#include <glm/vec3.hpp>

#include "common/config/species.h"
#include "master/capture/dynamics/anatomy.h"

namespace aquarama::capture {

using NodeVectors = std::array<glm::dvec3, body::kNodalPoints>;

// How far each group of muscles is contracted, 0 to 1: each group is one pair, above and below.
struct MuscleActivation {
    double frontLeft = 0, frontRight = 0;
    double middleLeft = 0, middleRight = 0;
    double backLeft = 0, backRight = 0;
};

// A plate of which only the normal moves water (Tu & Terzopoulos 1994).
struct PectoralFin {
    // gamma: the normal is cos(gamma) x + sin(gamma) y of the body frame. At pi/2 the fin lies flat
    // in the stream; above, it lifts the head of a fish that swims; at pi it stands across and
    // brakes.
    double angleRadians = std::numbers::pi / 2;
    // Of the fin against the body, forward, body lengths a second: rowing. Tu's fins do not row.
    double sweepSpeed = 0;
};

struct PectoralFins {
    PectoralFin left, right;
};

// All that a fish can do.
struct MotorControl {
    MuscleActivation muscles;
    PectoralFins fins;
};

struct Spring {
    std::uint8_t first = 0;
    std::uint8_t second = 0;  // > first
    double stiffness = 0;
    double restLength = 0;
};

// A face with what its shape, the water and its place on the fish make of it: the force is
// drag * area * (normal speed)^2.
struct WettedFace {
    std::array<std::uint8_t, 3> nodes{};
    double drag = 0;
};

struct BiomechanicalFish {
    NodeVectors restPositions{};
    std::array<double, body::kNodalPoints> masses{};  // sum 1
    std::array<Spring, kUnits> springs{};             // as anatomy().units
    std::array<WettedFace, kDragFaces> faces{};
    // What the water carries of each node beyond its weight. None: like Tu's, a fish of ours floats
    // where it is and rights itself with its fins alone.
    std::array<double, body::kNodalPoints> lifts{};
    double finDrag = 0;            // of each pectoral fin: force per normal speed
    double damping = 0;            // of every unit
    double muscleContraction = 0;  // share of its length lost at activation 1
    double timeScale = 1;          // clocks of controllers run this many times faster
};

struct FishState {
    NodeVectors positions{};
    NodeVectors velocities{};
};

// Throws Error when the springs do not hold the skeleton's shape.
[[nodiscard]] BiomechanicalFish makeBiomechanicalFish(const config::Species& species);
[[nodiscard]] FishState stateAtRest(const BiomechanicalFish& fish);

// One step of linearised backward Euler over the 69 coupled equations of motion (the paper's
// section 3): stable at any step, but it damps, so that a 60 Hz tick takes 8 * timeScale steps.
void step(const BiomechanicalFish& fish,
          const MotorControl& control,
          double stepSeconds,
          FishState& state);

// The step at which the published speeds hold; a longer one damps more.
[[nodiscard]] inline double longestStepSeconds(const BiomechanicalFish& fish) {
    return 1 / (480 * fish.timeScale);
}

}  // namespace aquarama::capture
