// SPDX-License-Identifier: Apache-2.0
// Control points computed from nodal points, for many fish: what poseCage() does to one.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "common/body/point_groups.h"
#include "common/body/spine.h"

namespace aquarama::body {

// Of each cage vertex: its shares in the knots of the spine (a posed vertex's place, direction and
// right are weighted sums of them), and its height and its distance to the right, in body lengths.
struct CageTables {
    using Numbers = std::array<float, kPointGroup>;
    struct alignas(64) Group {
        std::array<Numbers, kKnots> centre, tailwards, right;  // by knot
        Numbers y, z;
    };
    std::array<float, kKnots> stations{};
    std::array<Group, groupsOf(kControlPoints)> groups{};
};

// About 40 kB.
[[nodiscard]] CageTables makeCageTables(const FishBody& body);

// nodes of many fish, each in any frame and of its own length: lengths[fish] is a body length in
// their unit. controlPoints[fish * kControlPoints + i] in the same frame. Vectorised; within 1e-5
// body lengths of poseCage().
void poseCages(const CageTables& tables,
               std::span<const NodalPoints> nodes,
               std::span<const float> lengths,
               std::span<glm::vec3> controlPoints);

}  // namespace aquarama::body
