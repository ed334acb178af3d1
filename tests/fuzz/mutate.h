// SPDX-License-Identifier: Apache-2.0
// Damage to a file, the same for the same random numbers on every machine.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

namespace aquarama {

using FuzzInput = std::vector<std::uint8_t>;
using Random = std::mt19937;

// One of the seeds after one to four of: flip a bit, set a byte or a float to an extreme, cut the
// end, insert noise, repeat or drop a slice, go on as another seed does; in a text also: put an
// extreme in a number's place.
[[nodiscard]] FuzzInput mutated(const std::vector<FuzzInput>& seeds, Random& random);

}  // namespace aquarama
