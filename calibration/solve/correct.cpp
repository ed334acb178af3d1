// SPDX-License-Identifier: Apache-2.0
#include "calibration/solve/correct.h"

#include <array>
#include <cmath>

#include <Eigen/Sparse>
#include <glm/common.hpp>

namespace aquarama::solve {

namespace {

constexpr int kCellsAcross = 20;
constexpr double kPlacePixels = 0.05;  // of a tie
constexpr double kBendPixels = 0.15;   // from one control to the next
constexpr double kSizePixels = 3;      // of the whole

// A place of a channel's picture, 0 to 1, and what is left there.
struct Rest {
    glm::dvec2 share{}, pixels{};
    double weight = 0;
};

// Rows of a system of linear equations for the controls, and its two right sides.
class Equations {
  public:
    explicit Equations(const SmoothField& field) : field_{field} {}

    void add(const Rest& rest) {
        const SmoothField::Cell cell = field_.cellAt(glm::clamp(rest.share, 0.0, 1.0));
        const auto across = splineWeights(cell.within.x);
        const auto down = splineWeights(cell.within.y);
        for (int k = 0; k < 16; ++k)
            put(field_.control(cell.index.x + k % 4, cell.index.y + k / 4),
                rest.weight * across[static_cast<std::size_t>(k % 4)] *
                    down[static_cast<std::size_t>(k / 4)]);
        finish(rest.weight * rest.pixels);
    }
    void addBend(std::array<std::size_t, 3> controls) {
        put(controls[0], 1 / kBendPixels);
        put(controls[1], -2 / kBendPixels);
        put(controls[2], 1 / kBendPixels);
        finish({});
    }
    void addSize(std::size_t control) {
        put(control, 1 / kSizePixels);
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
    std::vector<Eigen::Triplet<double>> entries_;
    std::vector<glm::dvec2> right_;
    Eigen::Index rows_ = 0;
};

void addSmoothness(Equations& equations, const SmoothField& field) {
    const glm::ivec2 controls = field.cells() + 3;
    for (int row = 0; row < controls.y; ++row)
        for (int column = 0; column < controls.x; ++column) {
            equations.addSize(field.control(column, row));
            if (column > 0 && column + 1 < controls.x)
                equations.addBend({field.control(column - 1, row),
                                   field.control(column, row),
                                   field.control(column + 1, row)});
            if (row > 0 && row + 1 < controls.y)
                equations.addBend({field.control(column, row - 1),
                                   field.control(column, row),
                                   field.control(column, row + 1)});
        }
}

Correction fitted(const std::vector<Rest>& rests, glm::ivec2 cells) {
    Correction correction{SmoothField(cells), SmoothField(cells)};
    Equations equations(correction.across);
    for (const Rest& rest : rests) equations.add(rest);
    addSmoothness(equations, correction.across);
    const Eigen::MatrixX2d controls = equations.solve();
    for (Eigen::Index i = 0; i < controls.rows(); ++i) {
        correction.across.controls()[static_cast<std::size_t>(i)] = controls(i, 0);
        correction.down.controls()[static_cast<std::size_t>(i)] = controls(i, 1);
    }
    return correction;
}

// What is left at the ties of a channel.
std::vector<Rest> restsOf(const SolvedHall& hall,
                          const std::vector<Tie>& ties,
                          std::size_t channel) {
    const glm::dvec2 size(hall.rig.channels[channel].sizePixels);
    std::vector<Rest> rests;
    for (const Tie& tie : ties) {
        if (tie.heldOut || tie.channel != channel) continue;
        if (const auto place = hall.modelled(tie))
            rests.push_back(
                {tie.place / size, tie.place - *place, 1 / std::hypot(tie.sigma, kPlacePixels)});
    }
    return rests;
}

}  // namespace

void correct(SolvedHall& hall, const std::vector<Tie>& ties) {
    constexpr int kRounds = 3;  // of weights that make little of what lies far off
    for (std::size_t channel = 0; channel < hall.projectors.size(); ++channel) {
        const glm::dvec2 size(hall.rig.channels[channel].sizePixels);
        std::vector<Rest> rests = restsOf(hall, ties, channel);
        const glm::ivec2 cells(kCellsAcross, static_cast<int>(kCellsAcross * size.y / size.x));
        for (int round = 0; round < kRounds; ++round) {
            hall.corrections[channel] = fitted(rests, cells);
            for (Rest& rest : rests) {
                const double off =
                    glm::distance(hall.corrections[channel].at(rest.share), rest.pixels);
                const double scaled = off / (4 * kPlacePixels);
                rest.weight = 1 / kPlacePixels / std::sqrt(1 + scaled * scaled);
            }
        }
    }
}

}  // namespace aquarama::solve
