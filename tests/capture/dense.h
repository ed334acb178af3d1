// SPDX-License-Identifier: Apache-2.0
// Gauss-Jordan on a dense matrix: slow and plain, the oracle of what capture solves fast.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace aquarama::capture {

using DenseMatrix = std::vector<std::vector<double>>;  // rows

// Reduces the first `columns` columns, with the largest pivot of each; returns their rank.
inline std::size_t reduce(DenseMatrix& matrix, std::size_t columns) {
    std::size_t rank = 0;
    for (std::size_t column = 0; column < columns && rank < matrix.size(); ++column) {
        const auto best = std::max_element(matrix.begin() + static_cast<std::ptrdiff_t>(rank),
                                           matrix.end(),
                                           [&](const auto& a, const auto& b) {
                                               return std::abs(a[column]) < std::abs(b[column]);
                                           });
        if (std::abs((*best)[column]) < 1e-9) continue;
        std::swap(*best, matrix[rank]);
        const std::vector<double> pivot = matrix[rank];
        for (std::size_t row = 0; row < matrix.size(); ++row) {
            const double factor = matrix[row][column] / pivot[column];
            for (std::size_t k = 0; k < pivot.size(); ++k)
                matrix[row][k] =
                    row == rank ? pivot[k] / pivot[column] : matrix[row][k] - factor * pivot[k];
        }
        ++rank;
    }
    return rank;
}

// The solution of matrix * x = right.
inline std::vector<double> solveDense(DenseMatrix matrix, const std::vector<double>& right) {
    for (std::size_t row = 0; row < right.size(); ++row) matrix[row].push_back(right[row]);
    reduce(matrix, right.size());
    std::vector<double> solution;
    for (const auto& row : matrix) solution.push_back(row.back());
    return solution;
}

}  // namespace aquarama::capture
