// SPDX-License-Identifier: Apache-2.0
// The body frame B of a pose (the paper's eq. 1-5), with corrections that make it orthonormal and
// steady; and the linear system that one step of the dynamics solves.
#pragma once

#include <array>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "capture/biomechanical_fish.h"
#include "capture/step_lanes.h"
#include "common/body/fish_body.h"

namespace aquarama::capture {

// The body frame in the world; lengths are body lengths.
struct PoseFrame {
    glm::dvec3 origin{};          // the middle of ring 2
    glm::dmat3 worldFromBody{1};  // columns: x anterior, y dorsal, z right
};

// `pose` holds places in the world. The axes are a rotation: orthonormal and right-handed. The nose
// may not lie at the middle of ring 2, nor on its lateral axis.
[[nodiscard]] PoseFrame frameOf(const NodeVectors& pose);
// The same places in the body frame of the pose: the deformation d of eq. 8.
[[nodiscard]] NodeVectors inBodyFrame(const NodeVectors& pose);

// The symmetric positive definite 69 x 69 system of one step: assembled by nodes, solved by LDL^T.

// Stores only the upper triangle, and of each row only the elements that the fish's connections can
// fill: no unit reaches beyond the next ring, so a row has at most 24 elements (half-bandwidth 23),
// on average 16. Use: add all terms, solve() once, read solution(); clear() before the next use. A
// value on the stack of one thread; it allocates nothing.
class EnvelopeSystem {
  public:
    static constexpr int kUnknowns = 3 * body::kNodalPoints;

    // Sets all terms to zero.
    void clear() { rows_ = {}; }

    // Adds `value` to the three diagonal elements of a node: a term that is the same in x, y and z.
    void addToDiagonal(int node, double value);
    // Symmetric blocks; first < second, and `second` at most in the next ring.
    void addDiagonalBlock(int node, const glm::dmat3& block);
    void addOffDiagonalBlock(int first, int second, const glm::dmat3& block);
    void addToRightSide(int node, const glm::dvec3& value);

    // Writes the solution over the right side and overwrites the matrix. The matrix must be
    // positive definite: there is no pivoting.
    void solve();
    [[nodiscard]] glm::dvec3 solution(int node) const;

  private:
    void substituteBack();

    EnvelopeRows rows_;  // its right side is the solution at the end
};

}  // namespace aquarama::capture
