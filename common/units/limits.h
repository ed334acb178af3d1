// SPDX-License-Identifier: Apache-2.0
// The largest world: what is larger is refused where it comes in, by a reader or a decoder.
#pragma once

#include <cstdint>

namespace aquarama {

inline constexpr std::uint32_t kMostFish = 1'000'000;
inline constexpr std::uint32_t kMostSpecies = 64;  // sets of them are the bits of one number

}  // namespace aquarama
