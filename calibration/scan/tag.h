// SPDX-License-Identifier: Apache-2.0
// Where a camera sees the tag of a channel, whose pixels tell no place: by the places around it.
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "calibration/scan/decode.h"

namespace aquarama::scan {

// Least squares with N unknowns.
template <std::size_t N>
class LeastSquares {
  public:
    void add(const std::array<double, N>& row, double value) {
        for (std::size_t i = 0; i < N; ++i) {
            for (std::size_t j = 0; j < N; ++j) matrix_[i][j] += row[i] * row[j];
            matrix_[i][N] += row[i] * value;
        }
    }
    // By elimination with pivots; nothing where the rows do not determine it.
    [[nodiscard]] std::optional<std::array<double, N>> solve() const {
        auto m = matrix_;
        std::array<double, N> found{};
        for (std::size_t i = 0; i < N; ++i) {
            std::swap(m[i], m[pivotOf(m, i)]);
            if (std::abs(m[i][i]) < 1e-12) return std::nullopt;
            for (std::size_t j = 0; j < N; ++j)
                if (j != i) subtract(m[j], m[i], m[j][i] / m[i][i]);
        }
        for (std::size_t i = 0; i < N; ++i) found[i] = m[i][N] / m[i][i];
        return found;
    }

  private:
    using Row = std::array<double, N + 1>;
    static std::size_t pivotOf(const std::array<Row, N>& m, std::size_t column) {
        std::size_t pivot = column;
        for (std::size_t j = column + 1; j < N; ++j)
            if (std::abs(m[j][column]) > std::abs(m[pivot][column])) pivot = j;
        return pivot;
    }
    static void subtract(Row& from, const Row& row, double factor) {
        for (std::size_t k = 0; k <= N; ++k) from[k] -= factor * row[k];
    }
    std::array<Row, N> matrix_{};
};

class TagMap {
  public:
    // Nothing where too few places are seen around it, or they contradict each other.
    [[nodiscard]] static std::optional<TagMap> of(const ChannelView& view,
                                                  glm::ivec2 cameraPixels,
                                                  glm::ivec2 channelPixels);
    // From a camera's pixel (its index, whole at the centre) to cells right and down of the corner
    // of the tag.
    [[nodiscard]] glm::dvec2 cellAt(glm::dvec2 pixel) const;
    // The camera's pixels that it was found in.
    [[nodiscard]] glm::ivec2 low() const { return low_; }
    [[nodiscard]] glm::ivec2 high() const { return high_; }
    [[nodiscard]] double cellPixels() const { return cell_; }  // of the channel

    struct Sample {
        glm::ivec2 pixel{};
        glm::dvec2 cell{};
    };

  private:
    using Terms = std::array<double, 6>;  // of a polynomial of second order
    void frame(const std::vector<Sample>& samples, double cellPixels);
    [[nodiscard]] bool fit(const std::vector<Sample>& samples);
    [[nodiscard]] Terms termsAt(glm::dvec2 pixel) const;

    glm::ivec2 low_{1 << 20}, high_{-1};
    double cell_ = 1, scale_ = 1;
    glm::dvec2 middle_{};
    std::array<Terms, 2> fit_{};
};

}  // namespace aquarama::scan
