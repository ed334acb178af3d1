// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "master/capture/dynamics/biomechanical_fish.h"
#include "master/capture/dynamics/body_frame.h"
#include "master/capture/dynamics/envelope_system.h"

namespace aquarama::capture {

namespace {

constexpr std::array<int, 4> kLeftFinRoot{1, 4, 5, 8};
constexpr std::array<int, 4> kRightFinRoot{2, 3, 6, 7};

// Shares of rest length left, by UnitKind and Side.
using RestShares = std::array<std::array<double, 3>, 5>;

RestShares restShares(const MuscleActivation& muscles, double contraction) {
    const auto left = [&](double activation) {
        return 1 - contraction * std::clamp(activation, 0.0, 1.0);
    };
    return {{{1, 1, 1},
             {1, 1, 1},
             {1, left(muscles.frontLeft), left(muscles.frontRight)},
             {1, left(muscles.middleLeft), left(muscles.middleRight)},
             {1, left(muscles.backLeft), left(muscles.backRight)}}};
}

// A Voigt unit: spring and damper side by side, pulling along r / |r|. Its force is linearised in
// the velocities at the end of the step; in compression the geometric stiffness would be negative
// and is left out, which keeps the system positive definite at any step.
void addSpring(const Spring& spring,
               double length,
               double damping,
               double stepSeconds,
               const FishState& state,
               EnvelopeSystem& system) {
    const glm::dvec3 r = state.positions[spring.second] - state.positions[spring.first];
    const double distance = glm::length(r);
    const glm::dvec3 u = r / distance;
    const double force = spring.stiffness * (distance - length);
    const double geometric = std::max(0.0, force / distance);
    const double along = stepSeconds * (spring.stiffness - geometric) + damping;
    const glm::dmat3 block = glm::outerProduct(along * u, u) + glm::dmat3(stepSeconds * geometric);
    system.addDiagonalBlock(spring.first, block);
    system.addDiagonalBlock(spring.second, block);
    system.addOffDiagonalBlock(spring.first, spring.second, -block);
    system.addToRightSide(spring.first, force * u);
    system.addToRightSide(spring.second, -force * u);
}

// Only a face that advances into the water is pushed back (Tu & Terzopoulos 1994), here by the
// square of its normal speed: -drag A (n.v)^2 n, a third on each node, one factor (n.v) taken at
// the end of the step.
void addDrag(const WettedFace& face, const FishState& state, EnvelopeSystem& system) {
    const auto [a, b, c] = face.nodes;
    const glm::dvec3 areaVector = glm::cross(state.positions[b] - state.positions[a],
                                             state.positions[c] - state.positions[a]) /
                                  2.0;
    const glm::dvec3 velocity =
        (state.velocities[a] + state.velocities[b] + state.velocities[c]) / 3.0;
    const double flow = glm::dot(areaVector, velocity);  // area * normal speed
    if (flow <= 0) return;
    const double areaSquared = glm::dot(areaVector, areaVector);
    const glm::dvec3 scaled = face.drag / 9 * flow / areaSquared * areaVector;
    const glm::dmat3 block = glm::outerProduct(scaled, areaVector);
    for (std::size_t i = 0; i < 3; ++i) {
        system.addDiagonalBlock(face.nodes[i], block);
        const auto next = face.nodes[(i + 1) % 3];
        system.addOffDiagonalBlock(
            std::min(face.nodes[i], next), std::max(face.nodes[i], next), block);
    }
}

// -A (n.v) n, linear as Tu's, spread over the nodes at its root, of which v is the mean at the end
// of the step. Tu spreads it over rings 1 to 3; over the first two it pitches the fish twice as
// much.
void addFin(const PectoralFin& fin,
            const std::array<int, 4>& root,
            double drag,
            const glm::dmat3& worldFromBody,
            EnvelopeSystem& system) {
    const double across = std::cos(fin.angleRadians);
    const glm::dvec3 normal = worldFromBody * glm::dvec3(across, std::sin(fin.angleRadians), 0);
    const glm::dmat3 block = glm::outerProduct(drag / 16 * normal, normal);
    for (std::size_t i = 0; i < root.size(); ++i) {
        system.addDiagonalBlock(root[i], block);
        for (std::size_t j = i + 1; j < root.size(); ++j)
            system.addOffDiagonalBlock(root[i], root[j], block);
        system.addToRightSide(root[i], -drag / 4 * fin.sweepSpeed * across * normal);
    }
}

}  // namespace

void step(const BiomechanicalFish& fish,
          const MotorControl& control,
          double stepSeconds,
          FishState& state) {
    EnvelopeSystem system;
    for (int i = 0; i < body::kNodalPoints; ++i) {
        const auto node = static_cast<std::size_t>(i);
        const double inertia = fish.masses[node] / stepSeconds;
        system.addToDiagonal(i, inertia);
        system.addToRightSide(
            i, inertia * state.velocities[node] + glm::dvec3(0, fish.lifts[node], 0));
    }
    const RestShares shares = restShares(control.muscles, fish.muscleContraction);
    const auto& units = anatomy().units;
    for (std::size_t i = 0; i < kUnits; ++i) {
        const Spring& spring = fish.springs[i];
        const double share = shares.at(static_cast<std::size_t>(units[i].kind))
                                 .at(static_cast<std::size_t>(units[i].side));
        const double length = spring.restLength * share;
        addSpring(spring, length, fish.damping, stepSeconds, state, system);
    }
    for (const WettedFace& face : fish.faces) addDrag(face, state, system);
    const glm::dmat3 worldFromBody = frameOf(state.positions).worldFromBody;
    addFin(control.fins.left, kLeftFinRoot, fish.finDrag, worldFromBody, system);
    addFin(control.fins.right, kRightFinRoot, fish.finDrag, worldFromBody, system);
    system.solve();
    for (int i = 0; i < body::kNodalPoints; ++i) {
        const auto node = static_cast<std::size_t>(i);
        state.velocities[node] = system.solution(i);
        state.positions[node] += stepSeconds * state.velocities[node];
    }
}

}  // namespace aquarama::capture
