// SPDX-License-Identifier: Apache-2.0
// The biomechanical fish's connections: 23 nodal points, 91 spring-damper units of which 12 are
// muscles, and the faces that push water (Tu & Terzopoulos 1994; the paper's Fig. 1).
#pragma once

#include <array>
#include <cstdint>
#include <numbers>
#include <span>

#include <glm/vec3.hpp>

#include "common/body/fish_body.h"
#include "common/config/species.h"

namespace aquarama::capture {

inline constexpr int kUnits = 91;
inline constexpr int kMuscles = 12;
inline constexpr int kDragFaces = 78;

enum class UnitKind : std::uint8_t { Normal, Cross, FrontMuscle, MiddleMuscle, BackMuscle };
enum class Side : std::uint8_t { Neither, Left, Right };

// A spring with a damper between two nodal points; first < second.
struct Unit {
    std::uint8_t first = 0;
    std::uint8_t second = 0;
    UnitKind kind = UnitKind::Normal;
    Side side = Side::Neither;
    friend auto operator<=>(const Unit&, const Unit&) = default;
};

// A triangle of the surface, outward when seen counter-clockwise. Quads are split along both
// diagonals, each half counting half: along one alone, the fish would not be its own mirror image
// and would drift.
struct DragFace {
    std::array<std::uint8_t, 3> nodes{};
    double weight = 1;
};

struct Anatomy {
    std::array<Unit, kUnits> units;
    std::array<DragFace, kDragFaces> faces;
};
[[nodiscard]] const Anatomy& anatomy();

// The node that takes a node's place in a mirror.
[[nodiscard]] int mirroredLeftRight(int node);
[[nodiscard]] int mirroredTopBottom(int node);

// The biomechanical fish as plain data, and one step of its dynamics. Units: body lengths, the
// fish's mass, seconds.

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

// Whether springs hold a shape.

// All motions of the nodal points but moving and turning as one.
inline constexpr int kShapeChanges = 3 * body::kNodalPoints - 6;

// How many changes of shape, to first order, lengthen no unit: kShapeChanges less the rank of the
// rigidity matrix. A fish with one or more would fold up there at no cost.
[[nodiscard]] int freeShapeChanges(const NodeVectors& positions, std::span<const Unit> units);

}  // namespace aquarama::capture
