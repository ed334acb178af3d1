// SPDX-License-Identifier: Apache-2.0
// A smooth curve through a table that never swings past it, so that a body drawn by a few stations
// has no bulges of its own.
#pragma once

#include <vector>

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

}  // namespace aquarama::body
