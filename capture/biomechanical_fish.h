// SPDX-License-Identifier: Apache-2.0
// The biomechanical fish (Tu & Terzopoulos 1994; the paper's section 3 and Fig. 1): its connections
// (23 nodal points, 91 spring-damper units of which 12 are muscles, the faces that push water), its
// physical parameters, one step of its dynamics, and a test of its rigidity.
//
// Node numbers: 0 is the nose; ring r, 1 to 5 from head to tail, has the nodes 4 r - 3 to 4 r in
// the order dorsal left, dorsal right, ventral right, ventral left; 21 and 22 are the dorsal and
// the ventral tip of the tail. Everything here is plain data: no state is shared between threads.
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
inline constexpr int kFirstTailNode = 13;  // of ring 4

// A normal unit lies on the surface of the body, a cross unit braces a ring or a face against
// shear. A muscle is a unit along the body whose rest length a controller shortens.
enum class UnitKind : std::uint8_t { Normal, Cross, FrontMuscle, MiddleMuscle, BackMuscle };
// The side of the body, for a muscle; Neither for every other unit.
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
    double weight = 1;  // 1, or 1/2 for a half of a quad
};

// Connections without any length or strength: the same for every species.
struct Anatomy {
    std::array<Unit, kUnits> units;
    std::array<DragFace, kDragFaces> faces;
};
// Built on the first call, which may come from any thread; it lives as long as the program.
[[nodiscard]] const Anatomy& anatomy();

// The node at the mirror image of a node: in the plane z = 0 of the body frame (left and right),
// and in the plane y = 0 (top and bottom). Both are their own inverse.
[[nodiscard]] int mirroredLeftRight(int node);
[[nodiscard]] int mirroredTopBottom(int node);

// The biomechanical fish as plain data, and one step of its dynamics. Units: body lengths, the
// fish's mass, seconds.

// One vector for each nodal point: places, velocities or displacements.
using NodeVectors = std::array<glm::dvec3, body::kNodalPoints>;

// How far each group of muscles is contracted, 0 to 1; step() clamps what is outside. Each group is
// one pair, a dorsal and a ventral muscle of one segment and side.
struct MuscleActivation {
    double frontLeft = 0, frontRight = 0;
    double middleLeft = 0, middleRight = 0;
    double backLeft = 0, backRight = 0;
};

// A flat plate; water resists only its motion along its normal (Tu & Terzopoulos 1994).
struct FinPlate {
    // gamma: the normal is cos(gamma) x + sin(gamma) y of the body frame. At pi/2 the fin is
    // parallel to the flow. At a larger angle it lifts the head of a fish that swims forward. At pi
    // it is perpendicular to the flow and brakes.
    double angleRadians = std::numbers::pi / 2;
};

// Both fins. They have no mass and no state of their own.
struct FinPlates {
    FinPlate left, right;
};

// A pose of a pectoral fin (body::FinPose), and its change in a second; radians.
struct BladeMotion {
    glm::dvec3 pose{}, rate{};  // open, stroke, twist
};
// Both pectoral fins as blades that the water resists; the left one is told as the mirror image of
// the right. While a fish rows they take the place of the plates of FinPlates.
struct RowingControl {
    bool rows = false;
    BladeMotion left, right;
};

// How the tissue differs from that of a relaxed fish, as factors of what a species gives it.
// Damping stays as it is. A fish in a fast start is stiff: relaxed tissue bends, but does not push.
struct Tone {
    double stiffness = 1;          // of every unit
    double tailStiffness = 1;      // further: of the units behind ring 3 that are no muscles
    double contractStiffness = 1;  // further: of a muscle at activation 1
    double contraction = 1;        // of BiomechanicalFish::muscleContraction
    friend bool operator==(const Tone&, const Tone&) = default;
};

// Radians / (the fish's own second)^2: how quickly a fish that rights itself turns upright at most.
inline constexpr double kMostRighting = 4;

// All actuators of a fish during one step.
struct MotorControl {
    MuscleActivation muscles;
    FinPlates fins;
    RowingControl rowing;
    // Whether a moment rights the body, at most kMostRighting: that of the pelvic, the median and
    // the tail fins of a fish that rows, or is slow; they are not simulated.
    bool rightsItself = false;
    Tone tone;
};

// The pectoral fin of the right side as a blade (body::PectoralFin).
struct Blade {
    // Axes are unit vectors: tailwards, up, right. The root is seen from the origin of the body
    // frame.
    glm::dvec3 root{}, hinge{}, stroke{}, ray{}, chord{};
    double span = 0, area = 0;      // body lengths, and squared
    double rowing = 0, folded = 0;  // how far it is opened, radians
    // Water resists its motion along its normal, to either side, as it resists a face of the body:
    // force = drag * area * (normal speed)^2.
    double drag = 0;
};

// What muscles and tissue of a fish do at an instant: the stiffness and the rest length of each
// unit.
struct UnitState {
    double stiffness = 0;   // fish masses / s^2
    double restLength = 0;  // body lengths
};

// A unit with the strength that a species gives it. Its damping is BiomechanicalFish::damping.
struct Spring {
    std::uint8_t first = 0;
    std::uint8_t second = 0;  // > first
    double stiffness = 0;     // force by lengthening: fish masses / s^2
    double restLength = 0;    // body lengths, relaxed
};

// A face with its drag coefficient, which is the water's times the weight of the face and, on the
// head, a factor. The force is drag * area * (normal speed)^2, against the normal.
struct WettedFace {
    std::array<std::uint8_t, 3> nodes{};
    double drag = 0;
};

// The physical parameters of one species. Constant while it is simulated.
struct BiomechanicalFish {
    // Nose towards +x, back towards +y, right side towards +z; the nose is at the origin.
    NodeVectors restPositions{};
    std::array<double, body::kNodalPoints> masses{};  // sum 1
    std::array<Spring, kUnits> springs{};             // as anatomy().units
    std::array<WettedFace, kDragFaces> faces{};
    // Upward force on each node: buoyancy less weight. Zero in every species: like Tu's, the fish
    // is neutrally buoyant everywhere and rights itself with its fins alone. Tests set it.
    std::array<double, body::kNodalPoints> lifts{};
    Blade blade;
    double finDrag = 0;            // of each pectoral fin: force by normal speed, fish masses / s
    double damping = 0;            // of every unit: force by rate of lengthening, fish masses / s
    double muscleContraction = 0;  // share of the rest length that is lost at activation 1
    // The fish's own seconds in one second: the clocks of its controllers run this much faster.
    double timeScale = 1;
};

// Places (body lengths) and velocities (body lengths a second) of the nodes, in the world, y up.
struct FishState {
    NodeVectors positions{};
    NodeVectors velocities{};
    // Means over the last step, body lengths / s^2. Only the first guess of the next step: any
    // other value leads to the same motion, with more rounds of iteration.
    NodeVectors accelerations{};
};

// Throws Error when the springs do not hold the skeleton's shape, see freeShapeChanges().
[[nodiscard]] BiomechanicalFish makeBiomechanicalFish(const config::Species& species);
// Of the nodes, by their masses: of places the centre of mass, of velocities its velocity.
[[nodiscard]] glm::dvec3 meanOf(const BiomechanicalFish& fish, const NodeVectors& vectors);
// At the origin, straight, without motion.
[[nodiscard]] FishState stateAtRest(const BiomechanicalFish& fish);

// One step of the implicit midpoint rule over the 69 coupled equations of motion (the paper's
// section 3): all forces are taken at the middle of the step, at the mean of its two ends. The rule
// is of second order, keeps linear and angular momentum and, since a spring takes the mean of its
// lengths at both ends, energy; it adds no numerical damping
// (docs/decisions/0039-implicit-midpoint.md). Its equation is solved by Newton's method to some
// 5e-5 body lengths a second. `control` holds for the whole step: for second order it is that of
// the step's middle. stepSeconds is positive. Allocates nothing; costs one solution of the
// EnvelopeSystem in dynamics.h for each round of Newton's method, 1 to 1.5 on average while a fish
// swims steadily.
void step(const BiomechanicalFish& fish,
          const MotorControl& control,
          double stepSeconds,
          FishState& state);

// The units of a fish under a control, as step() takes them.
[[nodiscard]] std::array<UnitState, kUnits> unitStates(const BiomechanicalFish& fish,
                                                       const MotorControl& control);

// The step at which the speeds in the documents were measured: 8 * timeScale steps in a tick of
// 60 Hz. docs/motion.md says how far figures change with a shorter one.
[[nodiscard]] inline double longestStepSeconds(const BiomechanicalFish& fish) {
    return 1 / (480 * fish.timeScale);
}

// Whether springs hold a shape.

// Degrees of freedom of the nodal points without the six of a rigid body.
inline constexpr int kShapeChanges = 3 * body::kNodalPoints - 6;

// How many independent changes of shape, to first order, lengthen no unit: kShapeChanges minus the
// rank of the rigidity matrix. No spring resists these; a fish with one or more would collapse.
[[nodiscard]] int freeShapeChanges(const NodeVectors& positions, std::span<const Unit> units);

}  // namespace aquarama::capture
