// SPDX-License-Identifier: Apache-2.0
#include "common/body/monotone_curve.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace aquarama::body {

namespace {

// The piece of the table that holds `at`, which is inside of it.
std::size_t pieceOf(const std::vector<float>& x, float at) {
    const auto above = std::upper_bound(x.begin() + 1, x.end() - 1, at);
    return static_cast<std::size_t>(above - x.begin()) - 1;
}

float endSlope(float h0, float h1, float rise0, float rise1) {
    const float slope = ((2 * h0 + h1) * rise0 - h0 * rise1) / (h0 + h1);
    if (slope * rise0 <= 0) return 0;
    if (rise0 * rise1 <= 0 && std::abs(slope) > 3 * std::abs(rise0)) return 3 * rise0;
    return slope;
}

float middleSlope(float h0, float h1, float rise0, float rise1) {
    if (rise0 * rise1 <= 0) return 0;
    const float w0 = 2 * h1 + h0;
    const float w1 = h1 + 2 * h0;
    return (w0 + w1) / (w0 / rise0 + w1 / rise1);
}

}  // namespace

MonotoneCurve::MonotoneCurve(std::vector<float> x, std::vector<float> y)
    : x_(std::move(x)), y_(std::move(y)), slope_(x_.size()) {
    assert(x_.size() == y_.size() && x_.size() >= 2);
    const std::size_t pieces = x_.size() - 1;
    std::vector<float> h(pieces);
    std::vector<float> rise(pieces);
    for (std::size_t i = 0; i < pieces; ++i) {
        h[i] = x_[i + 1] - x_[i];
        rise[i] = (y_[i + 1] - y_[i]) / h[i];
    }
    if (pieces == 1) {
        slope_ = {rise[0], rise[0]};
        return;
    }
    for (std::size_t i = 1; i < pieces; ++i)
        slope_[i] = middleSlope(h[i - 1], h[i], rise[i - 1], rise[i]);
    slope_.front() = endSlope(h[0], h[1], rise[0], rise[1]);
    slope_.back() = endSlope(h[pieces - 1], h[pieces - 2], rise[pieces - 1], rise[pieces - 2]);
}

float MonotoneCurve::at(float x) const {
    if (x <= x_.front()) return y_.front();
    if (x >= x_.back()) return y_.back();
    const std::size_t i = pieceOf(x_, x);
    const float h = x_[i + 1] - x_[i];
    const float t = (x - x_[i]) / h;
    const float u = 1 - t;
    return y_[i] * (1 + 2 * t) * u * u + y_[i + 1] * (3 - 2 * t) * t * t +
           h * t * u * (slope_[i] * u - slope_[i + 1] * t);
}

float interpolate(const std::vector<float>& x, const std::vector<float>& y, float at) {
    if (at <= x.front()) return y.front();
    if (at >= x.back()) return y.back();
    const std::size_t i = pieceOf(x, at);
    const float t = (at - x[i]) / (x[i + 1] - x[i]);
    return y[i] + (y[i + 1] - y[i]) * t;
}

}  // namespace aquarama::body
