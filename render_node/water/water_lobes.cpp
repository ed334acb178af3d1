// SPDX-License-Identifier: Apache-2.0
#include "render_node/water/water_lobes.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace aquarama::scene {

namespace {

// Four neighbouring entries of one axis: their indices and their weights, which sum to 1.
struct Stencil {
    std::array<std::size_t, 4> at{};
    std::array<double, 4> share{};
};

// Catmull-Rom spline (Catmull and Rom 1974) at a fractional index. Its derivative is continuous: a
// kink at an entry would appear as a line in the gradient of open water. At either end the last
// entry is repeated.
Stencil smooth(double place, std::size_t count) {
    assert(count >= 2);
    const double inside = std::clamp(place, 0.0, static_cast<double>(count - 1));
    const auto left = static_cast<int>(std::min(inside, static_cast<double>(count) - 1.0001));
    const double t = inside - left;
    Stencil stencil;
    for (int i = 0; i < 4; ++i)
        stencil.at[static_cast<std::size_t>(i)] =
            static_cast<std::size_t>(std::clamp(left + i - 1, 0, static_cast<int>(count) - 1));
    stencil.share = {0.5 * (-t + 2 * t * t - t * t * t),
                     0.5 * (2 - 5 * t * t + 3 * t * t * t),
                     0.5 * (t + 4 * t * t - 3 * t * t * t),
                     0.5 * (-t * t + t * t * t)};
    return stencil;
}

// Fractional index of a value among ascending nodes that need not be evenly spaced; limited to the
// nodes.
template <std::size_t N>
double placeAmong(const std::array<double, N>& nodes, double value) {
    std::size_t right = 1;
    while (right + 1 < N && nodes[right] < value) ++right;
    const double t = (value - nodes[right - 1]) / (nodes[right] - nodes[right - 1]);
    return static_cast<double>(right - 1) + std::clamp(t, 0.0, 1.0);
}

// Optical depth is interpolated in its logarithm.
double opticalDepthIndex(double depth) {
    std::array<double, kLobeDepths.size()> logarithms{};
    std::ranges::transform(kLobeDepths, logarithms.begin(), [](double x) { return std::log(x); });
    return placeAmong(logarithms, std::log(std::max(depth, 1e-3)));
}

// Phase function of Henyey and Greenstein 1941, 1/sr; g is the mean cosine.
double henyeyGreenstein(double cosine, double g) {
    const double x = 1 + g * g - 2 * g * cosine;
    return (1 - g * g) / (4 * std::numbers::pi * x * std::sqrt(x));
}

}  // namespace

WaterLobe waterLobe(double albedo, double opticalDepth, double rise, double azimuthDegrees) {
    assert(albedo >= 0);
    assert(albedo <= 1);
    const Stencil a = smooth(placeAmong(kLobeAlbedos, albedo), kLobeAlbedos.size());
    const Stencil d = smooth(opticalDepthIndex(opticalDepth), kLobeDepths.size());
    const Stencil r = smooth(placeAmong(kLobeRises, rise), kLobeRises.size());
    const Stencil z = smooth(placeAmong(kLobeAzimuths, azimuthDegrees), kLobeAzimuths.size());
    double lnSource = 0;
    double loss = 0;
    // 4 x 4 x 4 x 4 entries; two bits of i for each axis.
    for (std::size_t i = 0; i < 256; ++i) {
        const std::size_t ia = i >> 6U;
        const std::size_t id = i >> 4U & 3U;
        const std::size_t ir = i >> 2U & 3U;
        const std::size_t iz = i & 3U;
        const double share = a.share[ia] * d.share[id] * r.share[ir] * z.share[iz];
        const std::size_t entry =
            ((a.at[ia] * kLobeDepths.size() + d.at[id]) * kLobeRises.size() + r.at[ir]) *
                kLobeAzimuths.size() +
            z.at[iz];
        lnSource += share * kLobeTable.at(entry).lnSource;
        loss += share * kLobeTable.at(entry).loss;
    }
    // The spline may overshoot: the loss stays positive.
    return {std::exp(lnSource / 1000), std::max(loss / 1000, 0.02)};
}

double plainLobe(glm::dvec3 direction, glm::dvec3 towardsSun) {
    return 0.22 * henyeyGreenstein(glm::dot(direction, towardsSun), 0.64) +
           0.10 * henyeyGreenstein(direction.y, 0.40);
}

}  // namespace aquarama::scene
