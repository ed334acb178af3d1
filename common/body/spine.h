// SPDX-License-Identifier: Apache-2.0
// A smooth curve through a table that never swings past it, so that a body drawn by a few stations
// has no bulges of its own.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

#include "common/body/fish_body.h"

namespace aquarama::body {

// Piecewise cubic Hermite with the slopes of Fritsch & Butland 1984 ("A method for constructing
// local monotone piecewise cubic interpolants"). x must rise; outside of the table the ends hold.
class MonotoneCurve {
  public:
    MonotoneCurve(std::vector<float> x, std::vector<float> y);
    [[nodiscard]] float at(float x) const;

  private:
    std::vector<float> x_;
    std::vector<float> y_;
    std::vector<float> slope_;
};

// Linear between the points of a table; outside of it the ends hold.
[[nodiscard]] float interpolate(const std::vector<float>& x, const std::vector<float>& y, float at);

// The bent axis of a fish: a cubic through nose, ring centres and tail.

inline constexpr std::size_t kKnots = 7;  // nose, five rings, tail

struct Spine {
    std::array<float, kKnots> stations{};
    std::array<glm::vec3, kKnots> centres{};
    std::array<glm::vec3, kKnots> slopes{};  // of centre by station
    std::array<glm::vec3, kKnots> right{};   // which way the fish's right is
};

[[nodiscard]] std::array<float, kKnots> knotStations(const FishBody& body);
[[nodiscard]] Spine spineOf(const std::array<float, kKnots>& stations, const NodalPoints& nodes);

// From stations and centres.
void setSlopes(Spine& spine);

// Where the axis is at a station, which way it runs and which way is right, both not normalised.
struct SpineSample {
    glm::vec3 centre{};
    glm::vec3 tailwards{};
    glm::vec3 right{};
};

// Cubic Hermite between knots, straight on behind the tail. Linear in all that the spine holds but
// its stations.
[[nodiscard]] SpineSample sampleAt(const Spine& spine, float station);

}  // namespace aquarama::body
