// SPDX-License-Identifier: Apache-2.0
#include "master/capture/dynamics/envelope_system.h"

namespace aquarama {

namespace {

constexpr auto kUnknowns = static_cast<std::size_t>(EnvelopeSystem::kUnknowns);

// The last node that a node shares an equation with once those before it are eliminated: the end of
// the next ring.
constexpr std::size_t lastNeighbour(std::size_t node) {
    const std::size_t nextRingsEnd = node == 0 ? 4 : 4 * ((node - 1) / 4 + 2);
    return nextRingsEnd < kNodalPoints ? nextRingsEnd : kNodalPoints - 1;
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

// Afterwards each row holds the inverse of its pivot and, right of it, its row of L^T.
void EnvelopeSystem::eliminate() {
    for (std::size_t i = 0; i < kUnknowns; ++i) {
        std::array<double, kLongestRow>& pivotRow = rows_[i];
        const std::size_t width = kWidths[i];
        const double inverse = 1 / pivotRow[0];
        for (std::size_t k = 1; k <= width; ++k) {
            const double factor = pivotRow[k] * inverse;
            double* target = rows_[i + k].data();
            const double* source = pivotRow.data() + k;
            for (std::size_t j = 0; j <= width - k; ++j) target[j] -= factor * source[j];
            right_[i + k] -= factor * right_[i];
        }
        for (std::size_t k = 1; k <= width; ++k) pivotRow[k] *= inverse;
        pivotRow[0] = inverse;
    }
}

void EnvelopeSystem::substituteBack() {
    for (std::size_t i = kUnknowns; i-- > 0;) {
        double value = right_[i] * rows_[i][0];
        for (std::size_t k = 1; k <= kWidths[i]; ++k) value -= rows_[i][k] * right_[i + k];
        right_[i] = value;
    }
}

glm::dvec3 EnvelopeSystem::solution(int node) const {
    const std::size_t row = 3 * static_cast<std::size_t>(node);
    return {right_[row], right_[row + 1], right_[row + 2]};
}

}  // namespace aquarama
