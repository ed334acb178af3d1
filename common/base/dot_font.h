// SPDX-License-Identifier: Apache-2.0
// A font of 5 x 7 dots with digits, capitals and a few signs, for labels in pictures.
#pragma once

#include <cstddef>
#include <cstdint>

namespace aquarama {

// Dots of a glyph.
inline constexpr std::size_t kGlyphColumns = 5;
inline constexpr std::size_t kGlyphRows = 7;

// The dots of a glyph: bit row * kGlyphColumns + column, from the top left dot.
using GlyphBits = std::uint64_t;
// The glyph of a character; 0, which is blank, for one that the font does not have.
[[nodiscard]] GlyphBits glyphOf(char character);

}  // namespace aquarama
