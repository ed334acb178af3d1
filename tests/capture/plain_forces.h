// SPDX-License-Identifier: Apache-2.0
// The forces on a biomechanical fish written down plainly, without a matrix: the oracle of step(),
// and the measure of where energy goes. Units: body lengths, the fish's mass, seconds.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include "capture/biomechanical_fish.h"
#include "capture/dynamics.h"

namespace aquarama::capture {

// By cause, on each node.
struct PlainForces {
    NodeVectors springs{};
    NodeVectors dampers{};
    NodeVectors water{};  // drag of the faces, and the pectoral fins
};

// Of a unit at this activation, body lengths.
inline double restLengthOf(const BiomechanicalFish& fish,
                           std::size_t unit,
                           const MuscleActivation& muscles) {
    const auto& [first, second, kind, side] = anatomy().units.at(unit);
    const bool left = side == Side::Left;
    double activation = 0;
    if (kind == UnitKind::FrontMuscle) activation = left ? muscles.frontLeft : muscles.frontRight;
    if (kind == UnitKind::MiddleMuscle)
        activation = left ? muscles.middleLeft : muscles.middleRight;
    if (kind == UnitKind::BackMuscle) activation = left ? muscles.backLeft : muscles.backRight;
    return fish.springs.at(unit).restLength *
           (1 - fish.muscleContraction * std::clamp(activation, 0.0, 1.0));
}

inline void addUnitForces(const BiomechanicalFish& fish,
                          const MuscleActivation& muscles,
                          const FishState& state,
                          PlainForces& forces) {
    for (std::size_t i = 0; i < kUnits; ++i) {
        const auto [a, b, stiffness, relaxed] = fish.springs.at(i);
        const glm::dvec3 r = state.positions.at(b) - state.positions.at(a);
        const glm::dvec3 along = glm::normalize(r);
        const double rate = glm::dot(along, state.velocities.at(b) - state.velocities.at(a));
        const double pull = stiffness * (glm::length(r) - restLengthOf(fish, i, muscles));
        forces.springs.at(a) += pull * along;
        forces.springs.at(b) -= pull * along;
        forces.dampers.at(a) += fish.damping * rate * along;
        forces.dampers.at(b) -= fish.damping * rate * along;
    }
}

inline void addWaterForces(const BiomechanicalFish& fish,
                           const MotorControl& control,
                           const FishState& state,
                           PlainForces& forces) {
    const auto& [x, v, a] = state;
    for (const WettedFace& face : fish.faces) {
        const auto [i, j, k] = face.nodes;
        const glm::dvec3 across = glm::cross(x.at(j) - x.at(i), x.at(k) - x.at(i));
        const glm::dvec3 normal = glm::normalize(across);
        const double speed = std::max(0.0, glm::dot(normal, v.at(i) + v.at(j) + v.at(k)) / 3);
        for (const std::size_t node : face.nodes)
            forces.water.at(node) -=
                face.drag * (glm::length(across) / 2) * speed * speed / 3 * normal;
    }
    const glm::dmat3 body = frameOf(x).worldFromBody;
    const auto push = [&](const FinPlate& fin, const std::array<std::size_t, 4>& root) {
        const double cosine = std::cos(fin.angleRadians);
        const glm::dvec3 normal = cosine * body[0] + std::sin(fin.angleRadians) * body[1];
        glm::dvec3 velocity{};
        for (const std::size_t node : root) velocity += v.at(node) / 4.0;
        for (const std::size_t node : root)
            forces.water.at(node) -= fish.finDrag * glm::dot(normal, velocity) / 4 * normal;
    };
    if (control.rowing.rows) return;
    push(control.fins.left, {1, 4, 5, 8});
    push(control.fins.right, {2, 3, 6, 7});
}

// Force and torque on one blade, cut into four strips across its ray; `side` is 1 on the right, -1
// on the left. The torque is about `centre`.
struct Wrench {
    glm::dvec3 force{}, torque{};
};
inline Wrench bladeWrench(const Blade& blade,
                          const BladeMotion& motion,
                          double side,
                          const FishState& state,
                          const glm::dvec3& centre,
                          const glm::dvec3& velocity,
                          const glm::dvec3& spin) {
    const PoseFrame frame = frameOf(state.positions);
    const auto inWorld = [&](const glm::dvec3& v) {
        return frame.worldFromBody * glm::dvec3(-v.x, v.y, side * v.z);
    };
    const auto turned = [](double angle, const glm::dvec3& axis, const glm::dvec3& v) {
        return glm::angleAxis(angle, axis) * v;
    };
    const auto posed = [&](double seconds, double twisted, const glm::dvec3& v) {
        const glm::dvec3 pose = motion.pose + seconds * motion.rate;
        return turned(pose.y,
                      blade.stroke,
                      turned(pose.x, blade.hinge, turned(twisted * pose.z, blade.ray, v)));
    };
    constexpr double kInstant = 1e-5;
    constexpr double kStrips = 4;
    Wrench wrench;
    for (double strip = 0.5; strip < kStrips; ++strip) {
        const double q = strip / kStrips;
        const auto middleAt = [&](double seconds) {
            return posed(seconds, 0, q * blade.span * blade.ray);
        };
        const glm::dvec3 arm = frame.origin + inWorld(blade.root + middleAt(0)) - centre;
        const glm::dvec3 own = (middleAt(kInstant) - middleAt(-kInstant)) / (2 * kInstant);
        const glm::dvec3 through = velocity + glm::cross(spin, arm) + inWorld(own);
        const glm::dvec3 normal =
            glm::normalize(inWorld(glm::cross(middleAt(0), posed(0, q, blade.chord))));
        const double speed = glm::dot(normal, through);
        const glm::dvec3 force =
            -blade.drag * blade.area / kStrips * std::abs(speed) * speed * normal;
        wrench.force += force;
        wrench.torque += glm::cross(arm, force);
    }
    return wrench;
}

// Nodes 1 to 8, rings 1 and 2, take the wrenches of both blades as a rigid body would.
inline void addBladeForces(const BiomechanicalFish& fish,
                           const RowingControl& rowing,
                           const FishState& state,
                           PlainForces& forces) {
    if (!rowing.rows) return;
    glm::dvec3 centre{}, velocity{}, momentum{};
    for (std::size_t i = 1; i <= 8; ++i) centre += state.positions.at(i) / 8.0;
    for (std::size_t i = 1; i <= 8; ++i) velocity += state.velocities.at(i) / 8.0;
    glm::dmat3 inertia(0);
    for (std::size_t i = 1; i <= 8; ++i) {
        const glm::dvec3 r = state.positions.at(i) - centre;
        momentum += glm::cross(r, state.velocities.at(i)) / 8.0;
        inertia += (glm::dmat3(glm::dot(r, r)) - glm::outerProduct(r, r)) / 8.0;
    }
    const glm::dvec3 spin = glm::inverse(inertia) * momentum;
    const Wrench left = bladeWrench(fish.blade, rowing.left, -1, state, centre, velocity, spin);
    const Wrench right = bladeWrench(fish.blade, rowing.right, 1, state, centre, velocity, spin);
    const glm::dvec3 turn = glm::inverse(inertia) * (left.torque + right.torque);
    for (std::size_t i = 1; i <= 8; ++i)
        forces.water.at(i) +=
            (left.force + right.force + glm::cross(turn, state.positions.at(i) - centre)) / 8.0;
}

inline PlainForces forcesOn(const BiomechanicalFish& fish,
                            const MotorControl& control,
                            const FishState& state) {
    PlainForces forces;
    addUnitForces(fish, control.muscles, state, forces);
    addWaterForces(fish, control, state, forces);
    addBladeForces(fish, control.rowing, state, forces);
    return forces;
}

// Energy a second that forces give to nodes.
inline double powerOf(const NodeVectors& forces, const NodeVectors& velocities) {
    double power = 0;
    for (std::size_t i = 0; i < forces.size(); ++i)
        power += glm::dot(forces.at(i), velocities.at(i));
    return power;
}

inline double kineticEnergyOf(const BiomechanicalFish& fish, const FishState& state) {
    double energy = 0;
    for (std::size_t i = 0; i < state.velocities.size(); ++i)
        energy += fish.masses.at(i) * glm::dot(state.velocities.at(i), state.velocities.at(i)) / 2;
    return energy;
}

// Of the springs, at the rest lengths of this activation.
inline double elasticEnergyOf(const BiomechanicalFish& fish,
                              const MuscleActivation& muscles,
                              const FishState& state) {
    double energy = 0;
    for (std::size_t i = 0; i < kUnits; ++i) {
        const Spring& spring = fish.springs.at(i);
        const double stretch =
            glm::distance(state.positions.at(spring.first), state.positions.at(spring.second)) -
            restLengthOf(fish, i, muscles);
        energy += spring.stiffness * stretch * stretch / 2;
    }
    return energy;
}

}  // namespace aquarama::capture
