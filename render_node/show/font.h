// SPDX-License-Identifier: Apache-2.0
// Digits, capitals and a few signs of 5 x 7 dots, for what an operator reads on the wall.
#pragma once

#include <cstddef>
#include <cstdint>

namespace aquarama::show {

inline constexpr std::size_t kGlyphColumns = 5;
inline constexpr std::size_t kGlyphRows = 7;

// One bit a dot, row by row from the top left.
using GlyphBits = std::uint64_t;
[[nodiscard]] GlyphBits glyphOf(char character);  // nothing for what it does not know

}  // namespace aquarama::show
