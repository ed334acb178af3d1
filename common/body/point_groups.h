// SPDX-License-Identifier: Apache-2.0
// How points lie in tables that vector units read: by sixteen, as many as the widest has lanes.
#pragma once

#include <algorithm>
#include <cstddef>

namespace aquarama::body {

inline constexpr std::size_t kPointGroup = 16;

constexpr std::size_t groupsOf(std::size_t points) {
    return (points + kPointGroup - 1) / kPointGroup;
}

// The last group ends at the last point and so overlaps the one before: whoever writes whole groups
// writes nothing beyond. Of kPointGroup points or more.
constexpr std::size_t firstPointOf(std::size_t group, std::size_t points) {
    return std::min(group * kPointGroup, points - kPointGroup);
}

}  // namespace aquarama::body
