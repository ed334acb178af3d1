// SPDX-License-Identifier: Apache-2.0
#include "tests/support/colour_difference.h"

#include <cmath>
#include <numbers>

#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>

#include "common/base/units.h"

namespace aquarama::test {

namespace {

double hueDegrees(double a, double b) {
    if (a == 0 && b == 0) return 0;
    const double hue = std::atan2(b, a) / kDegree;
    return hue < 0 ? hue + 360 : hue;
}

double chromaWeight(double chroma) {
    const double power = std::pow(chroma, 7);
    return std::sqrt(power / (power + std::pow(25.0, 7)));
}

double meanHue(double a, double b, bool isGrey) {
    if (isGrey) return a + b;
    if (std::abs(a - b) <= 180) return (a + b) / 2;
    return a + b < 360 ? (a + b + 360) / 2 : (a + b - 360) / 2;
}

double hueDifference(double a, double b, bool isGrey) {
    if (isGrey) return 0;
    const double off = b - a;
    return off > 180 ? off - 360 : off < -180 ? off + 360 : off;
}

}  // namespace

// Names as in Sharma's paper.
double ciede2000(glm::dvec3 labA, glm::dvec3 labB) {
    const double c = (std::hypot(labA.y, labA.z) + std::hypot(labB.y, labB.z)) / 2;
    const double g = 0.5 * (1 - chromaWeight(c));
    const double a1 = (1 + g) * labA.y;
    const double a2 = (1 + g) * labB.y;
    const double c1 = std::hypot(a1, labA.z);
    const double c2 = std::hypot(a2, labB.z);
    const double h1 = hueDegrees(a1, labA.z);
    const double h2 = hueDegrees(a2, labB.z);
    const bool isGrey = c1 * c2 == 0;
    const double dL = labB.x - labA.x;
    const double dC = c2 - c1;
    const double dH =
        2 * std::sqrt(c1 * c2) * std::sin(hueDifference(h1, h2, isGrey) / 2 * kDegree);
    const double meanL = (labA.x + labB.x) / 2;
    const double meanC = (c1 + c2) / 2;
    const double hue = meanHue(h1, h2, isGrey);
    const double t = 1 - 0.17 * std::cos((hue - 30) * kDegree) +
                     0.24 * std::cos(2 * hue * kDegree) + 0.32 * std::cos((3 * hue + 6) * kDegree) -
                     0.20 * std::cos((4 * hue - 63) * kDegree);
    const double sL =
        1 + 0.015 * (meanL - 50) * (meanL - 50) / std::sqrt(20 + (meanL - 50) * (meanL - 50));
    const double sC = 1 + 0.045 * meanC;
    const double sH = 1 + 0.015 * meanC * t;
    const double turn = 30 * std::exp(-std::pow((hue - 275) / 25, 2));
    const double rT = -2 * chromaWeight(meanC) * std::sin(2 * turn * kDegree);
    return std::sqrt(std::pow(dL / sL, 2) + std::pow(dC / sC, 2) + std::pow(dH / sH, 2) +
                     rT * dC / sC * dH / sH);
}

glm::dvec3 labOf(glm::dvec3 rgb) {
    const glm::dmat3 xyzFromRec709{{0.4124564, 0.2126729, 0.0193339},
                                   {0.3575761, 0.7151522, 0.1191920},
                                   {0.1804375, 0.0721750, 0.9503041}};
    const glm::dvec3 xyz = xyzFromRec709 * rgb / (xyzFromRec709 * glm::dvec3{1.0});
    const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116; };
    return {116 * f(xyz.y) - 16, 500 * (f(xyz.x) - f(xyz.y)), 200 * (f(xyz.y) - f(xyz.z))};
}

}  // namespace aquarama::test
