// SPDX-License-Identifier: Apache-2.0
// The distortion of a lens by the model of Brown (1966) and Conrady (1919).
#pragma once

#include <array>

#include <glm/mat2x2.hpp>
#include <glm/vec2.hpp>

namespace aquarama {

// Coefficients. A tangent is a point at distance one along the axis, x right and y down of it; the
// lens moves it to its image, in the same units. Scalar: double, or Ceres' dual numbers.
template <class Scalar>
struct BrownLens {
    Scalar k1{}, k2{}, k3{};  // radial
    Scalar p1{}, p2{};        // tangential

    // What the radial terms multiply a tangent by. `square`: of its length.
    [[nodiscard]] Scalar stretch(const Scalar& square) const {
        return 1.0 + square * (k1 + square * (k2 + square * k3));
    }
    // How fast the length of the image grows with that of the tangent, by the radial terms; where
    // it is not positive, the lens folds its picture.
    [[nodiscard]] Scalar growth(const Scalar& square) const {
        return 1.0 + square * (3.0 * k1 + 5.0 * square * k2 + 7.0 * square * square * k3);
    }
    [[nodiscard]] std::array<Scalar, 2> imageOf(const Scalar& x, const Scalar& y) const {
        const Scalar square = x * x + y * y;
        const Scalar radial = stretch(square);
        return {x * radial + 2.0 * p1 * x * y + p2 * (square + 2.0 * x * x),
                y * radial + p1 * (square + 2.0 * y * y) + 2.0 * p2 * x * y};
    }

    friend bool operator==(const BrownLens&, const BrownLens&) = default;
};

// Where a lens images a direction, as tangents of its angles.
[[nodiscard]] glm::dvec2 imageOf(const BrownLens<double>& lens, glm::dvec2 tangent);
// How the image moves with the tangent; symmetric.
[[nodiscard]] glm::dmat2 imageSlope(const BrownLens<double>& lens, glm::dvec2 tangent);
// The inverse of imageOf(): by the radial terms the tangent nearest the axis, where a lens that
// folds has several. Exact to 1e-14 where the lens does not fold before it.
[[nodiscard]] glm::dvec2 tangentOf(const BrownLens<double>& lens, glm::dvec2 image);

}  // namespace aquarama
