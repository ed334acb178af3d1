// SPDX-License-Identifier: Apache-2.0
// The skin of a fish through a cycle: the limit surface over the control cage, which follows the
// nodal points of each pose.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "common/body/fish_body.h"
#include "common/motion/repertoire.h"

namespace aquarama::exchange {

// One number a vertex; in the body frame, metres.
struct SkinShape {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
};

struct SwimmingSkin {
    std::vector<std::uint32_t> triangles;  // three vertices each, counter-clockwise from outside
    std::vector<SkinShape> shapes;         // evenly spaced in phase, the first at phase 0
};

// `shapes` divides kPhases.
[[nodiscard]] SwimmingSkin skinOf(const body::FishBody& body,
                                  const motion::ActionSegment& segment,
                                  double lengthMetres,
                                  int shapes);

}  // namespace aquarama::exchange
