// SPDX-License-Identifier: Apache-2.0
#include "capture/dynamics.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "capture/biomechanical_fish.h"

namespace aquarama::capture {

// Body frame.

// The paper takes the origin from one diagonal of ring 2 and the lateral axis from one edge. Shear
// of that ring then moves the frame up and down and rolls it by some degrees. The means over both
// diagonals and both edges do not move with the shear. y is normalised, since x is not quite
// perpendicular to the lateral axis.
PoseFrame frameOf(const NodeVectors& pose) {
    const glm::dvec3 origin = (pose[5] + pose[6] + pose[7] + pose[8]) / 4.0;
    const glm::dvec3 right = (pose[6] - pose[5]) + (pose[7] - pose[8]);
    const glm::dvec3 x = glm::normalize(pose[0] - origin);
    const glm::dvec3 y = glm::normalize(glm::cross(right, x));
    return {origin, {x, y, glm::cross(x, y)}};
}

NodeVectors inBodyFrame(const NodeVectors& pose) {
    const PoseFrame frame = frameOf(pose);
    const glm::dmat3 bodyFromWorld = glm::transpose(frame.worldFromBody);
    NodeVectors body{};
    for (std::size_t i = 0; i < pose.size(); ++i)
        body.at(i) = bodyFromWorld * (pose.at(i) - frame.origin);
    return body;
}

// The linear system.

void EnvelopeSystem::addToDiagonal(int node, double value) {
    for (std::size_t p = 0; p < 3; ++p)
        rows_.matrix[3 * static_cast<std::size_t>(node) + p][0] += value;
}

void EnvelopeSystem::addDiagonalBlock(int node, const glm::dmat3& block) {
    assert(node >= 0);
    assert(node < body::kNodalPoints);
    const std::size_t row = 3 * static_cast<std::size_t>(node);
    for (std::size_t p = 0; p < 3; ++p)
        for (std::size_t q = p; q < 3; ++q)
            rows_.matrix[row + p][q - p] += block[static_cast<int>(p)][static_cast<int>(q)];
}

void EnvelopeSystem::addOffDiagonalBlock(int first, int second, const glm::dmat3& block) {
    const std::size_t row = 3 * static_cast<std::size_t>(first);
    const std::size_t offset = 3 * static_cast<std::size_t>(second - first);
    for (std::size_t p = 0; p < 3; ++p)
        for (std::size_t q = 0; q < 3; ++q)
            rows_.matrix[row + p][offset + q - p] +=
                block[static_cast<int>(p)][static_cast<int>(q)];
}

void EnvelopeSystem::addToRightSide(int node, const glm::dvec3& value) {
    for (std::size_t p = 0; p < 3; ++p)
        rows_.right[3 * static_cast<std::size_t>(node) + p] += value[static_cast<int>(p)];
}

// LDL^T: about 12 thousand multiplications, where a dense solver needs 55 thousand.
void EnvelopeSystem::solve() {
    eliminate(rows_);
    substituteBack();
}

// Solves D L^T x = right from the last node to the first; the three unknowns of a node first take
// what later nodes contribute, then each other's share.
void EnvelopeSystem::substituteBack() {
    std::array<double, EnvelopeRows::kUnknowns>& right = rows_.right;
    for (std::size_t row = kUnknowns; row > 0;) {
        row -= 3;
        const std::size_t end = endOfRows(row / 3);
        for (std::size_t column = row + 3; column < end; ++column)
            for (std::size_t p = 0; p < 3; ++p)
                right[row + p] -= rows_.matrix[row + p][column - row - p] * right[column];
        for (std::size_t p = 3; p-- > 0;) {
            for (std::size_t q = p + 1; q < 3; ++q)
                right[row + p] -= rows_.matrix[row + p][q - p] * right[row + q];
            right[row + p] *= rows_.matrix[row + p][0];
        }
    }
}

glm::dvec3 EnvelopeSystem::solution(int node) const {
    const std::size_t row = 3 * static_cast<std::size_t>(node);
    return {rows_.right[row], rows_.right[row + 1], rows_.right[row + 2]};
}

namespace {

// Forces. Each function adds one force, at the middle of a step, to the system of one Newton
// iteration: to the right side the force itself, to the matrix minus its derivative by the
// velocities at the middle. The places at the middle are x + h/2 v, so that a derivative by places
// counts h/2 times.

// The left and right nodes of rings 1 and 2, ascending.
constexpr std::array<int, 4> kLeftFinRoot{1, 4, 5, 8};
constexpr std::array<int, 4> kRightFinRoot{2, 3, 6, 7};

// Activations, 0 to 1, by UnitKind and Side.
using Activations = std::array<std::array<double, 3>, 5>;

Activations activationsOf(const MuscleActivation& muscles) {
    const auto at = [](double activation) { return std::clamp(activation, 0.0, 1.0); };
    return {{{0, 0, 0},
             {0, 0, 0},
             {0, at(muscles.frontLeft), at(muscles.frontRight)},
             {0, at(muscles.middleLeft), at(muscles.middleRight)},
             {0, at(muscles.backLeft), at(muscles.backRight)}}};
}

UnitState stateOf(const Spring& spring, const Unit& unit, double activation, const Tone& tone) {
    double stiffness = spring.stiffness * tone.stiffness;
    if (unit.side != Side::Neither)
        stiffness *= 1 + (tone.contractStiffness - 1) * activation;
    else if (unit.first >= kFirstTailNode)
        stiffness *= tone.tailStiffness;
    return {stiffness, spring.restLength};
}

// What does not change during a step: the fish, its control, and what that makes of its units.
struct StepInput {
    const BiomechanicalFish& fish;
    const MotorControl& control;
    std::array<UnitState, kUnits> units;
    double halfStep = 0;
};

// Voigt units: spring and damper in parallel, each acting along r from its first node to the
// second:
//     force = stiffness (1 - length / l) r + damping (u.v) u,  u = r / |r|,  v = dr/dt,
// where l is the mean of the lengths at the two ends of the step. With |r| in place of l this would
// be the plain midpoint rule; with l, the work of the spring in the step is the change of its
// energy exactly, so that stiff springs cannot gain energy from the rule at any step (Greenspan
// 1984; Simo & Tarnow 1992). Each has the stiffness and the rest length of the step, with any
// contraction.
//
// The matrix has, with t = stiffness (1 - length / l),
//     h/2 (stiffness u u^T + g (1 - u u^T)) + damping u u^T,  g = max(0, t).
// In compression t is negative; it is left out there, which keeps the system positive definite at
// any step. So is the change of the damping force with the direction u, which is not symmetric.
// Both slow the convergence of the iteration a little and leave its limit as it is.
void addSprings(const StepInput& in, const FishState& middle, EnvelopeSystem& system) {
    UnitColumns units;
    for (std::size_t i = 0; i < kUnits; ++i) {
        const Spring& spring = in.fish.springs[i];
        units.offset.set(i, middle.positions[spring.second] - middle.positions[spring.first]);
        units.rate.set(i, middle.velocities[spring.second] - middle.velocities[spring.first]);
        units.stiffness[i] = in.units[i].stiffness;
        units.restLength[i] = in.units[i].restLength;
    }
    pullUnits(units, in.fish.damping, in.halfStep);
    for (std::size_t i = 0; i < kUnits; ++i) {
        const Spring& spring = in.fish.springs[i];
        const glm::dvec3 u = units.direction[i];
        const glm::dmat3 block =
            glm::outerProduct(units.along[i] * u, u) + glm::dmat3(units.across[i]);
        const glm::dvec3 force = units.pull[i] * units.offset[i];
        system.addDiagonalBlock(spring.first, block);
        system.addDiagonalBlock(spring.second, block);
        system.addOffDiagonalBlock(spring.first, spring.second, -block);
        system.addToRightSide(spring.first, force);
        system.addToRightSide(spring.second, -force);
    }
}

// Drag acts only on a face that advances into the water (Tu & Terzopoulos 1994), here with the
// square of its normal speed: -drag A (n.v)^2 n, where A is the area, n the outward normal and v
// the mean velocity of the three nodes. A third of it acts on each node. The derivative by places
// is left out of the matrix; it is small beside that by velocities.
void addDrag(const BiomechanicalFish& fish, const FishState& middle, EnvelopeSystem& system) {
    FaceColumns faces;
    for (std::size_t i = 0; i < kDragFaces; ++i) {
        const auto [a, b, c] = fish.faces[i].nodes;
        faces.second.set(i, middle.positions[b] - middle.positions[a]);
        faces.third.set(i, middle.positions[c] - middle.positions[a]);
        faces.velocities.set(i, middle.velocities[a] + middle.velocities[b] + middle.velocities[c]);
        faces.drag[i] = fish.faces[i].drag;
    }
    resistFaces(faces);
    for (std::size_t i = 0; i < kDragFaces; ++i) {
        if (faces.flow[i] <= 0) continue;
        const glm::dvec3 scaled = faces.scaled[i];
        const glm::dmat3 block = glm::outerProduct(2.0 / 3 * scaled, faces.area[i]);
        const auto& nodes = fish.faces[i].nodes;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            system.addDiagonalBlock(nodes[corner], block);
            const auto next = nodes[(corner + 1) % 3];
            system.addOffDiagonalBlock(
                std::min(nodes[corner], next), std::max(nodes[corner], next), block);
            system.addToRightSide(nodes[corner], -faces.flow[i] * scaled);
        }
    }
}

// -drag (n.v) n, linear in speed as Tu's law. v is the mean velocity of the four nodes at the fin's
// root; a quarter of the force acts on each of those nodes. Tu distributes it over rings 1 to 3;
// over the first two rings alone it pitches the fish twice as much. `worldFromBody` is the body
// frame at the middle of the step.
void addFin(const FinPlate& fin,
            const std::array<int, 4>& root,
            double drag,
            const glm::dmat3& worldFromBody,
            const FishState& middle,
            EnvelopeSystem& system) {
    const double across = std::cos(fin.angleRadians);
    const glm::dvec3 normal = worldFromBody * glm::dvec3(across, std::sin(fin.angleRadians), 0);
    const glm::dmat3 block = glm::outerProduct(drag / 16 * normal, normal);
    glm::dvec3 velocity{};
    for (const int node : root) velocity += middle.velocities[static_cast<std::size_t>(node)] / 4.0;
    const double normalSpeed = glm::dot(normal, velocity);
    for (std::size_t i = 0; i < root.size(); ++i) {
        system.addDiagonalBlock(root[i], block);
        for (std::size_t j = i + 1; j < root.size(); ++j)
            system.addOffDiagonalBlock(root[i], root[j], block);
        system.addToRightSide(root[i], -drag / 4 * normalSpeed * normal);
    }
}

// A blade is cut into strips across its ray, each with the speed of its middle.
constexpr int kStrips = 4;
// The nodes that a blade pushes, 1 to kBladeNodes: rings 1 and 2.
constexpr std::size_t kBladeNodes = 8;
// Each by as much.
constexpr std::array<double, body::kNodalPoints> kAlike = [] {
    std::array<double, body::kNodalPoints> masses{};
    masses.fill(1.0 / kBladeNodes);
    return masses;
}();

glm::dvec3 rotatedAbout(const glm::dvec3& axis, double angle, const glm::dvec3& v) {
    const double c = std::cos(angle);
    return c * v + std::sin(angle) * glm::cross(axis, v) + (1 - c) * glm::dot(axis, v) * axis;
}

// A point of the right blade at a share q of its ray: its place from the root, its velocity, and
// the chord there. Tailwards, up, right. A twist does not move the ray.
struct BladePoint {
    glm::dvec3 arm, velocity, chord;
};
BladePoint bladePoint(const Blade& blade, const BladeMotion& motion, double q) {
    const double open = motion.pose.x, stroke = motion.pose.y, twist = motion.pose.z;
    const auto carried = [&](const glm::dvec3& v) { return rotatedAbout(blade.stroke, stroke, v); };
    const glm::dvec3 opened = rotatedAbout(blade.hinge, open, q * blade.span * blade.ray);
    const glm::dvec3 arm = carried(opened);
    const glm::dvec3 chord = rotatedAbout(blade.ray, twist * q, blade.chord);
    return {.arm = arm,
            .velocity = motion.rate.y * glm::cross(blade.stroke, arm) +
                        motion.rate.x * carried(glm::cross(blade.hinge, opened)),
            .chord = carried(rotatedAbout(blade.hinge, open, chord))};
}

// Nodes as one rigid body: where it is, how it moves.
struct RigidBody {
    glm::dvec3 centre{}, velocity{}, spin{};
    glm::dmat3 inverseInertia{};
};
// Of the nodes `first` to `last`, each with its mass; the masses count relative to each other.
RigidBody rigidBody(const FishState& state,
                    const std::array<double, body::kNodalPoints>& masses,
                    std::size_t first,
                    std::size_t last) {
    RigidBody rigid;
    double all = 0;
    for (std::size_t i = first; i <= last; ++i) {
        all += masses[i];
        rigid.centre += masses[i] * state.positions[i];
        rigid.velocity += masses[i] * state.velocities[i];
    }
    rigid.centre /= all;
    rigid.velocity /= all;
    glm::dmat3 inertia(0);
    glm::dvec3 momentum{};
    for (std::size_t i = first; i <= last; ++i) {
        const glm::dvec3 r = state.positions[i] - rigid.centre;
        inertia += masses[i] * (glm::dmat3(glm::dot(r, r)) - glm::outerProduct(r, r));
        momentum += masses[i] * glm::cross(r, state.velocities[i]);
    }
    rigid.inverseInertia = glm::inverse(inertia);
    rigid.spin = rigid.inverseInertia * momentum;
    return rigid;
}

// A moment that turns the body upright, as a spring with damper does: the angular acceleration is
// kRighting^2 (y x up) - 2 damping kRighting spin, without the spin about y, the body's own up; at
// most kMostRighting.
void addRighting(const BiomechanicalFish& fish, const FishState& middle, EnvelopeSystem& system) {
    constexpr double kRighting = 2 * std::numbers::pi * 0.8;  // radians in the fish's own second
    constexpr double kDamping = 0.7;                          // of the critical one
    const double rate = kRighting * fish.timeScale;
    const RigidBody whole = rigidBody(middle, fish.masses, 0, body::kNodalPoints - 1);
    const glm::dvec3 up = frameOf(middle.positions).worldFromBody[1];
    const glm::dvec3 spin = whole.spin - glm::dot(whole.spin, up) * up;
    glm::dvec3 turn = rate * rate * glm::cross(up, {0, 1, 0}) - 2 * kDamping * rate * spin;
    const double most = kMostRighting * fish.timeScale * fish.timeScale;
    turn *= std::min(1.0, most / std::max(glm::length(turn), 1e-12));
    for (std::size_t i = 0; i < fish.masses.size(); ++i)
        system.addToRightSide(
            static_cast<int>(i),
            fish.masses[i] * glm::cross(turn, middle.positions[i] - whole.centre));
}

// -drag area |n.v| (n.v) n on each strip: the law of the faces of the body, but to either side. The
// sum of the strips' forces and torques is distributed over rings 1 and 2 as over a rigid body.
// `side`: 1 right, -1 left. The derivatives are left out of the matrix, which slows the iteration
// only.
void addBlade(const Blade& blade,
              const BladeMotion& motion,
              double side,
              const RigidBody& rings,
              const PoseFrame& frame,
              const FishState& middle,
              EnvelopeSystem& system) {
    const glm::dmat3 worldFromBlade{
        -frame.worldFromBody[0], frame.worldFromBody[1], side * frame.worldFromBody[2]};
    const glm::dvec3 root = frame.origin + worldFromBlade * blade.root;
    glm::dvec3 force{}, torque{};
    for (int strip = 0; strip < kStrips; ++strip) {
        const double q = (strip + 0.5) / kStrips;
        const BladePoint at = bladePoint(blade, motion, q);
        const glm::dvec3 arm = root + worldFromBlade * at.arm - rings.centre;
        const glm::dvec3 velocity =
            rings.velocity + glm::cross(rings.spin, arm) + worldFromBlade * at.velocity;
        const glm::dvec3 normal = worldFromBlade * glm::normalize(glm::cross(at.arm, at.chord));
        const double normalSpeed = glm::dot(normal, velocity);
        const glm::dvec3 onStrip =
            -blade.drag * blade.area / kStrips * std::abs(normalSpeed) * normalSpeed * normal;
        force += onStrip;
        torque += glm::cross(arm, onStrip);
    }
    const glm::dvec3 turn = rings.inverseInertia * torque;
    for (std::size_t i = 1; i <= kBladeNodes; ++i)
        system.addToRightSide(
            static_cast<int>(i),
            (force + glm::cross(turn, middle.positions[i] - rings.centre)) / double{kBladeNodes});
}

// The equation of the step. With v the velocities at its middle and v0 those at its beginning, the
// implicit midpoint rule is
//     2 m / h (v - v0) = force(x0 + h/2 v, v) + lift.
// Adds the inertia and the lift.
void addInertia(const BiomechanicalFish& fish,
                double halfStep,
                const FishState& start,
                const FishState& middle,
                EnvelopeSystem& system) {
    for (int i = 0; i < body::kNodalPoints; ++i) {
        const auto node = static_cast<std::size_t>(i);
        const double inertia = fish.masses[node] / halfStep;
        system.addToDiagonal(i, inertia);
        system.addToRightSide(i,
                              inertia * (start.velocities[node] - middle.velocities[node]) +
                                  glm::dvec3(0, fish.lifts[node], 0));
    }
}

// Forces on the body from within and from the water.
void addForces(const StepInput& in, const FishState& middle, EnvelopeSystem& system) {
    const BiomechanicalFish& fish = in.fish;
    addSprings(in, middle, system);
    addDrag(fish, middle, system);
    if (in.control.rightsItself) addRighting(fish, middle, system);
    const PoseFrame frame = frameOf(middle.positions);
    if (in.control.rowing.rows) {
        const RigidBody rings = rigidBody(middle, kAlike, 1, kBladeNodes);
        addBlade(fish.blade, in.control.rowing.left, -1, rings, frame, middle, system);
        addBlade(fish.blade, in.control.rowing.right, 1, rings, frame, middle, system);
        return;
    }
    addFin(in.control.fins.left, kLeftFinRoot, fish.finDrag, frame.worldFromBody, middle, system);
    addFin(in.control.fins.right, kRightFinRoot, fish.finDrag, frame.worldFromBody, middle, system);
}

// The iteration ends when no velocity changed by more than this in its last round, body lengths a
// second. What remains then is below a hundredth of it, since each round leaves less than that of
// the error. Steady swimming takes 1 to 1.5 rounds.
constexpr double kConverged = 0.005;
// Only a fish that was torn apart needs more; it is left where it is then.
constexpr int kMostRounds = 12;

// The middle of the step if the acceleration stays that of the step before: its error is of second
// order in the step.
FishState extrapolated(const FishState& start, double halfStep) {
    FishState middle = start;
    for (std::size_t i = 0; i < middle.positions.size(); ++i) {
        middle.velocities[i] += halfStep * start.accelerations[i];
        middle.positions[i] += halfStep * middle.velocities[i];
    }
    return middle;
}

// One round of Newton's method. Returns the largest change of a velocity.
double improve(const StepInput& in, const FishState& start, FishState& middle) {
    EnvelopeSystem system;
    addInertia(in.fish, in.halfStep, start, middle, system);
    addForces(in, middle, system);
    system.solve();
    double most = 0;
    for (int i = 0; i < body::kNodalPoints; ++i) {
        const auto node = static_cast<std::size_t>(i);
        const glm::dvec3 change = system.solution(i);
        most = std::max(most, glm::length(change));
        middle.velocities[node] += change;
        middle.positions[node] = start.positions[node] + in.halfStep * middle.velocities[node];
    }
    return most;
}

}  // namespace

std::array<UnitState, kUnits> unitStates(const BiomechanicalFish& fish,
                                         const MotorControl& control) {
    const Activations activations = activationsOf(control.muscles);
    const double contraction = fish.muscleContraction * control.tone.contraction;
    const auto& units = anatomy().units;
    std::array<UnitState, kUnits> states;
    for (std::size_t i = 0; i < kUnits; ++i) {
        const double activation = activations.at(static_cast<std::size_t>(units[i].kind))
                                      .at(static_cast<std::size_t>(units[i].side));
        states[i] = stateOf(fish.springs[i], units[i], activation, control.tone);
        states[i].restLength *= 1 - contraction * activation;
    }
    return states;
}

void step(const BiomechanicalFish& fish,
          const MotorControl& control,
          double stepSeconds,
          FishState& state) {
    assert(stepSeconds > 0);
    const StepInput in{fish, control, unitStates(fish, control), stepSeconds / 2};
    FishState middle = extrapolated(state, in.halfStep);
    for (int round = 0; round < kMostRounds; ++round)
        if (improve(in, state, middle) < kConverged) break;
    // The middle is the mean of both ends.
    for (std::size_t i = 0; i < state.positions.size(); ++i) {
        const glm::dvec3 gained = 2.0 * (middle.velocities[i] - state.velocities[i]);
        state.positions[i] += stepSeconds * middle.velocities[i];
        state.velocities[i] += gained;
        state.accelerations[i] = gained / stepSeconds;
    }
}

}  // namespace aquarama::capture
