// SPDX-License-Identifier: Apache-2.0
#include "common/body/spine.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace aquarama::body {

namespace {

// The piece of the table that contains `at`, which must lie between its ends. Binary search.
std::size_t pieceOf(const std::vector<float>& x, float at) {
    const auto above = std::upper_bound(x.begin() + 1, x.end() - 1, at);
    return static_cast<std::size_t>(above - x.begin()) - 1;
}

// Slope at an end of the table, from the two pieces next to it (h: widths, rise: slopes):
// three-point formula, limited so that the curve stays monotone.
float endSlope(float h0, float h1, float rise0, float rise1) {
    const float slope = ((2 * h0 + h1) * rise0 - h0 * rise1) / (h0 + h1);
    if (slope * rise0 <= 0) return 0;
    if (rise0 * rise1 <= 0 && std::abs(slope) > 3 * std::abs(rise0)) return 3 * rise0;
    return slope;
}

// Slope between two pieces: their weighted harmonic mean, 0 at an extremum of the table.
float middleSlope(float h0, float h1, float rise0, float rise1) {
    if (rise0 * rise1 <= 0) return 0;
    const float w0 = 2 * h1 + h0;
    const float w1 = h1 + 2 * h0;
    return (w0 + w1) / (w0 / rise0 + w1 / rise1);
}

// How far behind the tail the axis is continued; fins may reach beyond the tail's tip.
constexpr float kLastStation = 1.2F;

// Second-order difference on uneven stations; one-sided at the ends.
glm::vec3 slopeAt(const Spine& spine, std::size_t k) {
    const auto& s = spine.stations;
    const auto& c = spine.centres;
    if (k == 0) return (c[1] - c[0]) / (s[1] - s[0]);
    if (k == kKnots - 1) return (c[k] - c[k - 1]) / (s[k] - s[k - 1]);
    const float before = s[k] - s[k - 1];
    const float after = s[k + 1] - s[k];
    return (before * before * c[k + 1] + (after * after - before * before) * c[k] -
            after * after * c[k - 1]) /
           (before * after * (before + after));
}

}  // namespace

MonotoneCurve::MonotoneCurve(std::vector<float> x, std::vector<float> y)
    : x_(std::move(x)), y_(std::move(y)), slope_(x_.size()) {
    assert(x_.size() == y_.size());
    assert(x_.size() >= 2);
    assert(std::ranges::adjacent_find(x_, std::ranges::greater_equal{}) == x_.end());
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
    assert(!x.empty());
    assert(x.size() == y.size());
    if (at <= x.front()) return y.front();
    if (at >= x.back()) return y.back();
    const std::size_t i = pieceOf(x, at);
    const float t = (at - x[i]) / (x[i + 1] - x[i]);
    return y[i] + (y[i + 1] - y[i]) * t;
}

std::array<float, kKnots> knotStations(const FishBody& body) {
    const auto& r = body.ringStations;
    return {0, r[0], r[1], r[2], r[3], r[4], 1};
}

void setSlopes(Spine& spine) {
    for (std::size_t k = 0; k < kKnots; ++k) spine.slopes[k] = slopeAt(spine, k);
}

// The right of a ring: from its left to its right nodes. The tail has only two nodes: its right is
// perpendicular to them and to the axis, on the side of the last ring's.
Spine spineOf(const std::array<float, kKnots>& stations, const NodalPoints& n) {
    Spine spine{.stations = stations};
    spine.centres[0] = n[0];
    for (std::size_t r = 0; r < 5; ++r) {
        const std::size_t a = 1 + 4 * r;
        spine.centres[r + 1] = (n[a] + n[a + 1] + n[a + 2] + n[a + 3]) / 4.0F;
        spine.right[r + 1] = glm::normalize(n[a + 1] + n[a + 2] - n[a] - n[a + 3]);
    }
    spine.centres[6] = (n[21] + n[22]) / 2.0F;
    spine.right[0] = spine.right[1];
    const glm::vec3 tail =
        glm::normalize(glm::cross(n[21] - n[22], spine.centres[5] - spine.centres[6]));
    spine.right[6] = glm::dot(tail, spine.right[5]) < 0 ? -tail : tail;
    setSlopes(spine);
    return spine;
}

// A linear search is enough for 7 knots. `beyond` exceeds 1 behind the tail, where the curve goes
// on along its end slope.
SpineSample sampleAt(const Spine& spine, float station) {
    const float s = std::clamp(station, 0.0F, kLastStation);
    std::size_t i = 0;
    while (i < kKnots - 2 && s >= spine.stations[i + 1]) ++i;
    const float h = spine.stations[i + 1] - spine.stations[i];
    const float beyond = (s - spine.stations[i]) / h;
    const float t = std::min(beyond, 1.0F);
    const glm::vec3 c0 = spine.centres[i];
    const glm::vec3 c1 = spine.centres[i + 1];
    const glm::vec3 m0 = h * spine.slopes[i];
    const glm::vec3 m1 = h * spine.slopes[i + 1];
    const float t2 = t * t;
    const float t3 = t2 * t;
    return {.centre = (2 * t3 - 3 * t2 + 1) * c0 + (t3 - 2 * t2 + t) * m0 + (3 * t2 - 2 * t3) * c1 +
                      (t3 - t2) * m1 + (beyond - t) * m1,
            .tailwards =
                (6 * t2 - 6 * t) * (c0 - c1) + (3 * t2 - 4 * t + 1) * m0 + (3 * t2 - 2 * t) * m1,
            .right = glm::mix(spine.right[i], spine.right[i + 1], t)};
}

}  // namespace aquarama::body
