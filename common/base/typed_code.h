// SPDX-License-Identifier: Apache-2.0
// Codes that people read on one screen and type on another: eight letters of Crockford's base 32,
// 40 bits.
#pragma once

#include <string>
#include <string_view>

namespace aquarama {

// A new code, from the system's random numbers.
[[nodiscard]] std::string freshCode();
// As a screen shows it, in two halves: "K7M4-QD9X".
[[nodiscard]] std::string shownCode(const std::string& code);
// The part of a typed text that counts: capitals, without spaces and hyphens, and with the letters
// that are mistaken for digits read as such. What is no code stays none.
[[nodiscard]] std::string plainCode(std::string_view typed);

}  // namespace aquarama
