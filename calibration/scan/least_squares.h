// SPDX-License-Identifier: Apache-2.0
// Least squares with a few unknowns, by the normal equations.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include <Eigen/LU>

namespace aquarama::scan {

// Least squares with N unknowns: minimises the sum of (row * unknowns - value)^2.
template <std::size_t N>
class LeastSquares {
  public:
    // Adds an equation: the row times the unknowns is the value.
    void add(const std::array<double, N>& row, double value) {
        const Eigen::Map<const Vector> terms(row.data());
        matrix_ += terms * terms.transpose();
        right_ += value * terms;
    }
    // The unknowns; nothing where the rows do not determine them.
    [[nodiscard]] std::optional<std::array<double, N>> solve() const {
        constexpr double kLeastPivot = 1e-12;
        const Eigen::PartialPivLU<Matrix> factors(matrix_);
        if (!(factors.matrixLU().diagonal().cwiseAbs().minCoeff() >= kLeastPivot))
            return std::nullopt;
        std::array<double, N> found{};
        Eigen::Map<Vector>(found.data()) = factors.solve(right_);
        return found;
    }

  private:
    static constexpr int kCount = static_cast<int>(N);
    using Vector = Eigen::Matrix<double, kCount, 1>;
    using Matrix = Eigen::Matrix<double, kCount, kCount>;
    Matrix matrix_ = Matrix::Zero();
    Vector right_ = Vector::Zero();
};

}  // namespace aquarama::scan
