// SPDX-License-Identifier: Apache-2.0
// The parameters that the search may change, as a unit cube.
#pragma once

#include <vector>

#include "common/config/species.h"

namespace aquarama::search {

// A point of the cube: each coordinate goes from a parameter's least value at 0 to its most at 1 by
// equal factors.
using SearchPoint = std::vector<double>;

// Parameters outside their range come out on its edge.
[[nodiscard]] SearchPoint pointOf(const config::Species& species);
[[nodiscard]] config::Species speciesAt(const SearchPoint& point, const config::Species& species);

}  // namespace aquarama::search
