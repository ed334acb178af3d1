// SPDX-License-Identifier: Apache-2.0
// Noise in space for what is only drawn; a stream of random numbers for shapes.
#pragma once

#include <cstdint>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "common/units/hash.h"

namespace aquarama::scene {

[[nodiscard]] float solidNoise(std::uint32_t seed, glm::vec3 place);            // -1 to 1
[[nodiscard]] float billows(std::uint32_t seed, glm::vec3 place, int octaves);  // about +-1
[[nodiscard]] float ridges(std::uint32_t seed, glm::vec3 place, int octaves);   // crests at +1

class Dice {
  public:
    explicit Dice(std::uint32_t seed) : seed_{seed} {}
    float unit() { return unitOf(hashOf(seed_, count_++)); }
    float between(float low, float high) { return low + (high - low) * unit(); }
    std::uint32_t seed() { return hashOf(seed_, count_++); }

  private:
    std::uint32_t seed_;
    std::uint32_t count_ = 0;
};

// Columns x, y, z with y along `up`, turned about it.
[[nodiscard]] glm::mat3 frameAbout(glm::vec3 up, float turnRadians);

}  // namespace aquarama::scene
