// SPDX-License-Identifier: Apache-2.0
#include "calibration/geometry/smooth_fit.h"

#include <array>
#include <cmath>

#include <Eigen/Sparse>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace aquarama::geometry {

namespace {

// Rows of a system of linear equations for the controls, and its two right sides.
class Equations {
  public:
    Equations(const SmoothField& field, const Smoothness& smoothness)
        : field_{field}, smoothness_{smoothness} {}

    void add(const Measured& measured) {
        const SmoothField::Cell cell = field_.cellAt(glm::clamp(measured.share, 0.0, 1.0));
        const auto across = splineWeights(cell.within.x);
        const auto down = splineWeights(cell.within.y);
        for (int k = 0; k < 16; ++k)
            put(field_.control(cell.index.x + k % 4, cell.index.y + k / 4),
                measured.weight * across[static_cast<std::size_t>(k % 4)] *
                    down[static_cast<std::size_t>(k / 4)]);
        finish(measured.weight * measured.values);
    }
    void addBend(std::array<std::size_t, 3> controls) {
        put(controls[0], 1 / smoothness_.bend);
        put(controls[1], -2 / smoothness_.bend);
        put(controls[2], 1 / smoothness_.bend);
        finish({});
    }
    void addSize(std::size_t control) {
        put(control, 1 / smoothness_.size);
        finish({});
    }

    // Both columns of the solution.
    [[nodiscard]] Eigen::MatrixX2d solve() const {
        Eigen::SparseMatrix<double> matrix(rows_,
                                           static_cast<Eigen::Index>(field_.controls().size()));
        matrix.setFromTriplets(entries_.begin(), entries_.end());
        Eigen::MatrixX2d right(rows_, 2);
        for (Eigen::Index i = 0; i < rows_; ++i) {
            const glm::dvec2 side = right_[static_cast<std::size_t>(i)];
            right.row(i) << side.x, side.y;
        }
        const Eigen::SparseMatrix<double> normal = matrix.transpose() * matrix;
        const Eigen::MatrixX2d projected = matrix.transpose() * right;
        return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(normal).solve(projected);
    }

  private:
    void put(std::size_t control, double value) {
        entries_.emplace_back(static_cast<int>(rows_), static_cast<int>(control), value);
    }
    void finish(glm::dvec2 right) {
        right_.push_back(right);
        ++rows_;
    }
    const SmoothField& field_;
    const Smoothness& smoothness_;
    std::vector<Eigen::Triplet<double>> entries_;
    std::vector<glm::dvec2> right_;
    Eigen::Index rows_ = 0;
};

// Three neighbouring controls, across or down.
void addBends(Equations& equations, const SmoothField& field, glm::ivec2 way) {
    const glm::ivec2 controls = field.cells() + 3;
    for (int row = way.y; row + way.y < controls.y; ++row)
        for (int column = way.x; column + way.x < controls.x; ++column)
            equations.addBend({field.control(column - way.x, row - way.y),
                               field.control(column, row),
                               field.control(column + way.x, row + way.y)});
}

void addSmoothness(Equations& equations, const SmoothField& field) {
    for (std::size_t control = 0; control < field.controls().size(); ++control)
        equations.addSize(control);
    addBends(equations, field, {1, 0});
    addBends(equations, field, {0, 1});
}

FieldPair fitted(const std::vector<Measured>& measured,
                 glm::ivec2 cells,
                 const Smoothness& smoothness) {
    FieldPair pair{SmoothField(cells), SmoothField(cells)};
    Equations equations(pair.first, smoothness);
    for (const Measured& one : measured) equations.add(one);
    addSmoothness(equations, pair.first);
    const Eigen::MatrixX2d controls = equations.solve();
    for (Eigen::Index i = 0; i < controls.rows(); ++i) {
        pair.first.controls()[static_cast<std::size_t>(i)] = controls(i, 0);
        pair.second.controls()[static_cast<std::size_t>(i)] = controls(i, 1);
    }
    return pair;
}

}  // namespace

FieldPair smoothFit(std::vector<Measured> measured,
                    glm::ivec2 cells,
                    const Smoothness& smoothness,
                    double far,
                    int rounds) {
    std::vector<double> sure;
    for (const Measured& one : measured) sure.push_back(one.weight);
    FieldPair pair;
    for (int round = 0; round < rounds; ++round) {
        pair = fitted(measured, cells, smoothness);
        for (std::size_t i = 0; i < measured.size(); ++i) {
            const double off = glm::distance(pair.at(measured[i].share), measured[i].values) / far;
            measured[i].weight = sure[i] / std::sqrt(1 + off * off);
        }
    }
    return pair;
}

}  // namespace aquarama::geometry
