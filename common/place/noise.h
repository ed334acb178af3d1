// SPDX-License-Identifier: Apache-2.0
// Noise by integer hashes: the same bits on every machine, from a seed and a place alone.
#pragma once

#include <cstdint>

#include <glm/vec2.hpp>

namespace aquarama::place {

// A well-mixed 32-bit number ("lowbias32", Wellons 2018).
[[nodiscard]] constexpr std::uint32_t hashOf(std::uint32_t x) {
    x ^= x >> 16U;
    x *= 0x7feb352dU;
    x ^= x >> 15U;
    x *= 0x846ca68bU;
    x ^= x >> 16U;
    return x;
}

[[nodiscard]] constexpr std::uint32_t hashOf(std::uint32_t seed, std::uint32_t index) {
    return hashOf(hashOf(seed) ^ (index * 0x9e3779b9U));
}

// 0 inclusive to 1 exclusive; exact, as 24 bits fit a float.
[[nodiscard]] constexpr float unitOf(std::uint32_t hash) {
    return static_cast<float>(hash >> 8U) * (1.0F / 16777216.0F);
}

// -1 to 1.
[[nodiscard]] constexpr float signedUnitOf(std::uint32_t hash) {
    return unitOf(hash) * 2.0F - 1.0F;
}

// Smooth (C2) value noise, -1 to 1, lattice of side 1.
[[nodiscard]] float valueNoise(std::uint32_t seed, glm::vec2 place);

// Octaves of it, each of twice the frequency and half the height; within -2 to 2.
[[nodiscard]] float fractalNoise(std::uint32_t seed, glm::vec2 place, int octaves);

}  // namespace aquarama::place
