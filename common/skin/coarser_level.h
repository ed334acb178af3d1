// SPDX-License-Identifier: Apache-2.0
// How a level of detail hangs on the next coarser one, so that a mesh may grow out of it without a
// jump.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "common/skin/limit_table.h"

namespace aquarama::skin {

// For each vertex of makeLimitTable(body, level) the two vertices of the same table in whose middle
// the triangles of the next coarser level have it; twice itself for those that the coarser level
// has too. level is at least 1.
[[nodiscard]] std::vector<std::array<std::uint32_t, 2>> coarserParents(const body::FishBody& body,
                                                                       int level,
                                                                       const LimitTable& coarser);

}  // namespace aquarama::skin
