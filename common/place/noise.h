// SPDX-License-Identifier: Apache-2.0
// Noise by integer hashes: the same bits on every machine, from a seed and a place alone.
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>

namespace aquarama::place {

// Smooth (C2) value noise, -1 to 1, lattice of side 1.
[[nodiscard]] float valueNoise(std::uint32_t seed, glm::vec2 place);

// Octaves of it, each of twice the frequency and half the height; within -2 to 2.
[[nodiscard]] float fractalNoise(std::uint32_t seed, glm::vec2 place, int octaves);

}  // namespace aquarama::place
