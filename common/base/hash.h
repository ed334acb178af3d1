// SPDX-License-Identifier: Apache-2.0
// Pseudo-random numbers from integers alone: the same bits on every machine. Compiled as C++ and as
// GLSL.
#ifndef AQUARAMA_HASH_H
#define AQUARAMA_HASH_H
#ifdef __cplusplus
#include <cstdint>
namespace aquarama {
using uint = std::uint32_t;
// clang-format off
[[nodiscard]] constexpr
#endif
// A well-mixed 32-bit number ("lowbias32", Wellons 2018).
uint hashOf(uint x) {
    x ^= x >> 16U;
    x *= 0x7feb352dU;
    x ^= x >> 15U;
    x *= 0x846ca68bU;
    x ^= x >> 16U;
    return x;
}
#ifdef __cplusplus
[[nodiscard]] constexpr
#endif
// A number from 0 (included) to 1 (excluded); exact, since 24 bits fit a float.
float unitOf(uint hash) {
    return float(hash >> 8U) * (1.0F / 16777216.0F);
}
#ifdef __cplusplus
// clang-format on

// Number `index` of the sequence of a seed, in any order of calls.
[[nodiscard]] constexpr std::uint32_t hashOf(std::uint32_t seed, std::uint32_t index) {
    return hashOf(hashOf(seed) ^ (index * 0x9e3779b9U));
}

// A number from -1 to 1.
[[nodiscard]] constexpr float signedUnitOf(std::uint32_t hash) {
    return unitOf(hash) * 2.0F - 1.0F;
}

}  // namespace aquarama
#endif
#endif
