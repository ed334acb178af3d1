// SPDX-License-Identifier: Apache-2.0
#include "common/base/brown_lens.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace aquarama {

namespace {

// The least r with r * stretch(r^2) = the length of the image: by Newton's method, within bounds.
double radialTangent(const BrownLens<double>& lens, double image) {
    constexpr int kSteps = 64;
    double low = 0, high = image / kSteps;
    // The image grows up to the picture's corners, so the first crossing is the right one.
    for (int i = 0; high * lens.stretch(high * high) < image && i < 64 * kSteps; ++i) {
        low = high;
        high += image / kSteps;
    }
    double r = (low + high) / 2;
    for (int i = 0; i < 60 && high - low > 1e-15 * image; ++i) {
        const double square = r * r;
        const double off = r * lens.stretch(square) - image;
        (off < 0 ? low : high) = r;
        const double next = r - off / lens.growth(square);
        if (std::abs(next - r) < 1e-15 * image) break;
        r = next > low && next < high ? next : (low + high) / 2;
    }
    return r;
}

}  // namespace

glm::dvec2 imageOf(const BrownLens<double>& lens, glm::dvec2 tangent) {
    const auto [x, y] = lens.imageOf(tangent.x, tangent.y);
    return {x, y};
}

glm::dmat2 imageSlope(const BrownLens<double>& lens, glm::dvec2 at) {
    const double square = glm::dot(at, at);
    const double stretch = lens.stretch(square);
    const double bend = lens.k1 + square * (2 * lens.k2 + square * 3 * lens.k3);
    const double across = 2 * at.x * at.y * bend + 2 * lens.p1 * at.x + 2 * lens.p2 * at.y;
    return {stretch + 2 * at.x * at.x * bend + 2 * lens.p1 * at.y + 6 * lens.p2 * at.x,
            across,
            across,
            stretch + 2 * at.y * at.y * bend + 6 * lens.p1 * at.y + 2 * lens.p2 * at.x};
}

glm::dvec2 tangentOf(const BrownLens<double>& lens, glm::dvec2 image) {
    const double length = glm::length(image);
    if (lens == BrownLens<double>{} || length == 0) return image;
    glm::dvec2 tangent = image * (radialTangent(lens, length) / length);
    if (lens.p1 == 0 && lens.p2 == 0) return tangent;
    constexpr int kMostSteps = 50;
    for (int i = 0; i < kMostSteps; ++i) {  // Newton's method: the tangential terms are small
        const glm::dvec2 off = imageOf(lens, tangent) - image;
        if (glm::dot(off, off) < 1e-28) break;
        tangent -= glm::inverse(imageSlope(lens, tangent)) * off;
    }
    return tangent;
}

}  // namespace aquarama
