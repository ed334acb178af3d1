// SPDX-License-Identifier: Apache-2.0
// Curves through tables, and the bent axis of a fish. The curves do not overshoot their tables, so
// a body that is drawn with a few stations has no bulges between them.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <glm/vec3.hpp>

#include "common/body/fish_body.h"

namespace aquarama::body {

// Piecewise cubic Hermite with the slopes of Fritsch & Butland 1984 ("A method for constructing
// local monotone piecewise cubic interpolants"). x must rise strictly, with at least two points;
// outside of the table the value of the nearest end holds.
class MonotoneCurve {
  public:
    // The curve through (x[i], y[i]).
    MonotoneCurve(std::vector<float> x, std::vector<float> y);
    // Cost: a binary search.
    [[nodiscard]] float at(float x) const;

  private:
    std::vector<float> x_;
    std::vector<float> y_;
    // dy/dx at each point of the table.
    std::vector<float> slope_;
};

// Linear between the points of a table whose x rises; outside of it the value of the nearest end
// holds. x and y have the same number of points.
[[nodiscard]] float interpolate(const std::vector<float>& x, const std::vector<float>& y, float at);

// The bent axis of a fish: a cubic through nose, ring centres and tail.

inline constexpr std::size_t kKnots = 7;  // nose, five rings, tail

// The bent axis at one moment; positions in the frame of the nodal points.
struct Spine {
    std::array<float, kKnots> stations{};
    std::array<glm::vec3, kKnots> centres{};
    // Derivative of the centre by the station.
    std::array<glm::vec3, kKnots> slopes{};
    // Unit vectors to the right of the fish.
    std::array<glm::vec3, kKnots> right{};
};

// Stations of the knots of a body: nose 0, its rings, tail 1.
[[nodiscard]] std::array<float, kKnots> knotStations(const FishBody& body);
// The spine of a posed fish.
[[nodiscard]] Spine spineOf(const std::array<float, kKnots>& stations, const NodalPoints& nodes);

// Sets the slopes from stations and centres.
void setSlopes(Spine& spine);

// The axis at a station: its place, its direction and the direction to the right. The directions
// are not normalised.
struct SpineSample {
    glm::vec3 centre{};
    glm::vec3 tailwards{};
    glm::vec3 right{};
};

// Cubic Hermite between knots; behind the tail a straight line, up to station 1.2. For fixed
// stations linear in all that the spine holds.
[[nodiscard]] SpineSample sampleAt(const Spine& spine, float station);

}  // namespace aquarama::body
