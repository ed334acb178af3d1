// SPDX-License-Identifier: Apache-2.0
// A captured fish seen from above: outlines for drawing.
#pragma once

#include <vector>

#include <glm/vec2.hpp>

#include "common/body/fish_body.h"
#include "common/motion/repertoire.h"
#include "master/capture/measure/measure.h"

namespace aquarama {

// World x to the right of the paper, world z (the right of a fish that heads along x) down.
[[nodiscard]] glm::dvec2 fromAbove(const glm::dvec3& world);

struct FishView {
    std::vector<glm::dvec2> outline;                 // of body and tail
    std::vector<std::vector<glm::dvec2>> pectorals;  // left and right
    std::vector<glm::dvec2> midline;                 // from nose to tip of the tail
    std::vector<glm::dvec2> eyes;
};
[[nodiscard]] FishView viewFromAbove(const FishBody& body, const ReplayedPhase& phase);

}  // namespace aquarama
