// SPDX-License-Identifier: Apache-2.0
#include "master/capture/dynamics/envelope_system.h"

namespace aquarama::capture {

namespace {

constexpr auto kUnknowns = static_cast<std::size_t>(EnvelopeSystem::kUnknowns);

// The last node that a node shares an equation with once those before it are eliminated: the end of
// the next ring.
constexpr std::size_t lastNeighbour(std::size_t node) {
    const std::size_t nextRingsEnd = node == 0 ? 4 : 4 * ((node - 1) / 4 + 2);
    return nextRingsEnd < body::kNodalPoints ? nextRingsEnd : body::kNodalPoints - 1;
}

// Number of elements of each row right of the diagonal.
constexpr auto kWidths = [] {
    std::array<std::size_t, kUnknowns> widths{};
    for (std::size_t row = 0; row < kUnknowns; ++row)
        widths[row] = 3 * lastNeighbour(row / 3) + 2 - row;
    return widths;
}();

}  // namespace

void EnvelopeSystem::clear() {
    rows_ = {};
    right_ = {};
}

void EnvelopeSystem::addToDiagonal(int node, double value) {
    for (std::size_t p = 0; p < 3; ++p) rows_[3 * static_cast<std::size_t>(node) + p][0] += value;
}

void EnvelopeSystem::addDiagonalBlock(int node, const glm::dmat3& block) {
    const std::size_t row = 3 * static_cast<std::size_t>(node);
    for (std::size_t p = 0; p < 3; ++p)
        for (std::size_t q = p; q < 3; ++q)
            rows_[row + p][q - p] += block[static_cast<int>(p)][static_cast<int>(q)];
}

void EnvelopeSystem::addOffDiagonalBlock(int first, int second, const glm::dmat3& block) {
    const std::size_t row = 3 * static_cast<std::size_t>(first);
    const std::size_t offset = 3 * static_cast<std::size_t>(second - first);
    for (std::size_t p = 0; p < 3; ++p)
        for (std::size_t q = 0; q < 3; ++q)
            rows_[row + p][offset + q - p] += block[static_cast<int>(p)][static_cast<int>(q)];
}

void EnvelopeSystem::addToRightSide(int node, const glm::dvec3& value) {
    for (std::size_t p = 0; p < 3; ++p)
        right_[3 * static_cast<std::size_t>(node) + p] += value[static_cast<int>(p)];
}

void EnvelopeSystem::solve() {
    eliminate();
    substituteBack();
}

// Node by node: its three rows end at the same column, so that one pass takes them out of each row
// behind. Afterwards each row holds the inverse of its pivot and, right of it, its row of D L^T.
void EnvelopeSystem::eliminate() {
    for (std::size_t row = 0; row < kUnknowns; row += 3) {
        const std::size_t end = row + kWidths[row] + 1;
        invertPivot(row);
        subtract<1>(row, row + 1, end);
        invertPivot(row + 1);
        subtract<2>(row, row + 2, end);
        invertPivot(row + 2);
        for (std::size_t target = row + 3; target < end; ++target) subtract<3>(row, target, end);
    }
}

void EnvelopeSystem::invertPivot(std::size_t row) {
    rows_[row][0] = 1 / rows_[row][0];
}

// Takes the first `count` unknowns from `row` on, whose pivots are inverted, out of a row behind.
template <std::size_t count>
void EnvelopeSystem::subtract(std::size_t row, std::size_t target, std::size_t end) {
    std::array<double, count> factors;
    std::array<const double*, count> sources;
    for (std::size_t i = 0; i < count; ++i) {
        sources[i] = rows_[row + i].data() + (target - row - i);
        factors[i] = sources[i][0] * rows_[row + i][0];
        right_[target] -= factors[i] * right_[row + i];
    }
    double* const elements = rows_[target].data();
    for (std::size_t k = 0; k < end - target; ++k)
        for (std::size_t i = 0; i < count; ++i) elements[k] -= factors[i] * sources[i][k];
}

void EnvelopeSystem::substituteBack() {
    for (std::size_t row = kUnknowns; row > 0;) {
        row -= 3;
        const std::size_t end = row + kWidths[row] + 1;
        for (std::size_t column = row + 3; column < end; ++column)
            for (std::size_t p = 0; p < 3; ++p)
                right_[row + p] -= rows_[row + p][column - row - p] * right_[column];
        for (std::size_t p = 3; p-- > 0;) {
            for (std::size_t q = p + 1; q < 3; ++q)
                right_[row + p] -= rows_[row + p][q - p] * right_[row + q];
            right_[row + p] *= rows_[row + p][0];
        }
    }
}

glm::dvec3 EnvelopeSystem::solution(int node) const {
    const std::size_t row = 3 * static_cast<std::size_t>(node);
    return {right_[row], right_[row + 1], right_[row + 2]};
}

}  // namespace aquarama::capture
