// SPDX-License-Identifier: Apache-2.0
// The body frame B of a pose (the paper's eq. 1-5), with the remedies that make it orthonormal and
// steady.
#pragma once

#include <array>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "common/body/fish_body.h"
#include "master/capture/biomechanical_fish.h"

namespace aquarama::capture {

struct PoseFrame {
    glm::dvec3 origin{};
    glm::dmat3 worldFromBody{1};  // columns: x anterior, y dorsal, z right
};

[[nodiscard]] PoseFrame frameOf(const NodeVectors& pose);
[[nodiscard]] NodeVectors inBodyFrame(const NodeVectors& pose);  // eq. 8

// The symmetric positive definite 69 x 69 system of one step: assembled by nodes, solved by LDL^T.

// Only the upper triangle, and of each row only what the fish's connections can fill: a node meets
// none behind the next ring, so a row is at most 24 long (half-bandwidth 23) and on the average 18.
// Rows are contiguous, so that eliminating one is a run of vector operations.
class EnvelopeSystem {
  public:
    static constexpr int kUnknowns = 3 * body::kNodalPoints;
    static constexpr int kLongestRow = 24;

    EnvelopeSystem() { clear(); }
    void clear();

    void addToDiagonal(int node, double value);
    // Symmetric blocks; first < second.
    void addDiagonalBlock(int node, const glm::dmat3& block);
    void addOffDiagonalBlock(int first, int second, const glm::dmat3& block);
    void addToRightSide(int node, const glm::dvec3& value);

    // Leaves the solution in the right side; the matrix is used up.
    void solve();
    [[nodiscard]] glm::dvec3 solution(int node) const;

  private:
    void eliminate();
    void invertPivot(std::size_t row);
    template <std::size_t count>
    void subtract(std::size_t row, std::size_t target, std::size_t end);
    void substituteBack();

    std::array<std::array<double, kLongestRow>, kUnknowns>
        rows_;  // rows_[i][k] is element (i, i+k)
    std::array<double, kUnknowns> right_;
};

}  // namespace aquarama::capture
