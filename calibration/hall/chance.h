// SPDX-License-Identifier: Apache-2.0
// Random numbers for halls: the same for the same seed on every machine.
#pragma once

#include <cmath>
#include <cstdint>

#include <glm/vec3.hpp>

#include "common/base/hash.h"

namespace aquarama::hall {

// A sequence of independent draws.
class Chance {
  public:
    explicit Chance(std::uint32_t seed) : seed_{seed} {}
    // An evenly distributed number.
    [[nodiscard]] double between(double low, double high) {
        return low + (high - low) * static_cast<double>(unitOf(hashOf(seed_, next_++)));
    }
    // From -most to most.
    [[nodiscard]] double within(double most) { return between(-most, most); }
    [[nodiscard]] glm::dvec3 within(glm::dvec3 most) {
        const double x = within(most.x), y = within(most.y), z = within(most.z);
        return {x, y, z};
    }
    // One of 0 to count - 1.
    [[nodiscard]] int below(int count) { return static_cast<int>(between(0, count)); }
    // A direction of length one, evenly over the sphere.
    [[nodiscard]] glm::dvec3 direction() {
        const double z = within(1), turn = within(3.141592653589793);
        const double side = std::sqrt(1 - z * z);
        return {side * std::cos(turn), side * std::sin(turn), z};
    }

  private:
    std::uint32_t seed_, next_ = 0;
};

}  // namespace aquarama::hall
