// SPDX-License-Identifier: Apache-2.0
// The control points that a frame shows: those of eq. 13, and the fins moved beside them. The CPU
// reference of fish_pose.glsl.
#pragma once

#include <span>

#include <glm/vec3.hpp>

#include "common/body/fish_body.h"
#include "common/motion/reconstruct.h"
#include "common/motion/repertoire.h"

namespace aquarama::test {

// seconds: of the show. World frame, metres.
void livingCage(const body::FishBody& body,
                const motion::Repertoire& repertoire,
                const motion::PresentedFish& fish,
                float seconds,
                std::span<glm::vec3> points);

}  // namespace aquarama::test
