// SPDX-License-Identifier: Apache-2.0
// Bytes that nobody can foresee, for keys and secrets.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace aquarama {

// Throws Error where the system has no random numbers.
void fillRandom(std::span<unsigned char> bytes);

// So many of them. Throws as fillRandom().
template <std::size_t count>
[[nodiscard]] std::array<unsigned char, count> randomBytes() {
    std::array<unsigned char, count> bytes{};
    fillRandom(bytes);
    return bytes;
}

}  // namespace aquarama
