// SPDX-License-Identifier: Apache-2.0
// The arithmetic of a step that takes most of its time: the pull of all units, the drag of all
// faces, and the elimination, as many numbers at a time as a vector has lanes. Every width of
// vectors gives the same bits. Body lengths, the fish's mass, seconds; world frame.
#pragma once

#include <array>
#include <cstddef>

#include "capture/biomechanical_fish.h"
#include "common/body/fish_body.h"

namespace aquarama::capture {

// The widest vector, in numbers. Columns and rows have room for a whole one behind their last.
inline constexpr std::size_t kMostDoubles = 8;

// A column with an element for each of `count`, and room for whole vectors. Nothing is set at
// first, as that would take a tenth of a step; what is behind the last element does not matter.
template <std::size_t count>
using Column = std::array<double, (count + kMostDoubles - 1) / kMostDoubles * kMostDoubles>;

// One vector in space for each element.
template <std::size_t count>
struct VectorColumns {
    Column<count> x, y, z;

    // Writes vector i.
    void set(std::size_t i, const glm::dvec3& v) {
        x[i] = v.x;
        y[i] = v.y;
        z[i] = v.z;
    }
    // Reads vector i.
    [[nodiscard]] glm::dvec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
};

// The units at the middle of a step. A value of one thread.
struct UnitColumns {
    // In: from the first node to the second, and its change; what the unit does (UnitState).
    VectorColumns<kUnits> offset, rate;
    Column<kUnits> stiffness, restLength;
    // Out: the direction of the offset; the derivative of the force along it, and across it; the
    // force divided by the offset.
    VectorColumns<kUnits> direction;
    Column<kUnits> along, across, pull;
};
// Computes what addSprings() in dynamics.cpp says. No offset may be zero.
void pullUnits(UnitColumns& units, double damping, double halfStepSeconds);

// The faces at the middle of a step. A value of one thread.
struct FaceColumns {
    // In: two edges, from the first node to the others; the sum of the nodes' velocities; and
    // WettedFace::drag.
    VectorColumns<kDragFaces> second, third, velocities;
    Column<kDragFaces> drag;
    // Out: the outward normal times the area; the area times the speed along the normal; and the
    // normal times a third of the drag.
    VectorColumns<kDragFaces> area;
    Column<kDragFaces> flow;
    VectorColumns<kDragFaces> scaled;
};
// Computes what addDrag() in dynamics.cpp says. No face may be without area.
void resistFaces(FaceColumns& faces);

// The symmetric matrix of a step and its right side; see EnvelopeSystem.
struct EnvelopeRows {
    static constexpr std::size_t kUnknowns = 3 * std::size_t{body::kNodalPoints};
    static constexpr std::size_t kLongestRow = 24;

    // matrix[i][k] is the element (i, i + k). What is behind the width of a row is zero.
    std::array<std::array<double, kLongestRow + kMostDoubles>, kUnknowns> matrix{};
    std::array<double, kUnknowns> right{};
};
// One past the last column of the rows of a node, after fill-in: it shares equations with the nodes
// of the next ring.
[[nodiscard]] constexpr std::size_t endOfRows(std::size_t node) {
    const std::size_t nextRingsEnd = node == 0 ? 4 : 4 * ((node - 1) / 4 + 2);
    const std::size_t last =
        nextRingsEnd < body::kNodalPoints ? nextRingsEnd : std::size_t{body::kNodalPoints} - 1;
    return 3 * last + 3;
}
// Node by node: its three rows end at the same column, so that one pass subtracts all three from
// each later row. Afterwards each row holds the inverse of its pivot and, right of it, its row of
// D L^T. The right side is reduced in the same pass.
void eliminate(EnvelopeRows& system);

}  // namespace aquarama::capture
