// SPDX-License-Identifier: Apache-2.0
// A fish between two ticks, as a frame shows it, and its nodal points (eq. 12).
#pragma once

#include <span>

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

#include "common/motion/motion_state.h"
#include "common/motion/motor.h"
#include "common/motion/repertoire.h"

namespace aquarama::motion {

// One fish as a frame shows it: between two ticks in the live show, at a tick in lockstep. 80
// bytes, uploaded to the GPU as they are (std430).
struct PresentedFish {
    glm::vec3 positionMetres{};
    float lengthMetres = 0.0F;
    glm::vec4 rotation{0, 0, 0, 1};  // quaternion (x, y, z, w), body to world
    float phase = 0.0F;              // cycles, [0, 1)
    float fromPhase = 0.0F;
    // Share of `action`, the rest is that of `fromAction`; 1 when no warp is under way.
    float warpWeight = 1.0F;
    std::uint32_t action = 0;
    std::uint32_t fromAction = 0;
    std::uint32_t id = 0;
    float speed = 0.0F;   // body lengths a second
    float spread = 0.0F;  // of the pectoral fins, 0 to 1
    // Where it looks: body frame, a vector no longer than 1; and how far its mouth is open, 0 to 1.
    glm::vec3 gaze{1, 0, 0};
    float mouth = 0.0F;
};
static_assert(sizeof(PresentedFish) == 80);

// Interpolates between two ticks: fraction 0 shows `before`, 1 shows `after`, the next tick. A fish
// that left its segment in between goes from the pose that it left to the first pose of the warp;
// any other change of segment is shown as in `after`. If the fish is away at one of the ticks, the
// record of that tick is shown: nothing.
[[nodiscard]] PresentedFish present(const FishRecord& before,
                                    const FishRecord& after,
                                    float fraction,
                                    const FishTraits& traits);

// Whether the fish is away (see kAwayHeightMetres) and so not drawn.
[[nodiscard]] inline bool isAway(const PresentedFish& fish) {
    return fish.positionMetres.y < 0.5F * kAwayHeightMetres;
}

// The nodal points in the body frame, in body lengths (eq. 12 before R and o), interpolated between
// samples and, in a warp, between segments.
void nodalPose(const Repertoire& repertoire, const PresentedFish& fish, body::NodalPoints& nodes);
// The pectoral fins likewise, left and right.
[[nodiscard]] std::array<body::FinPose, 2> finPoses(const Repertoire& repertoire,
                                                    const PresentedFish& fish);

// Eq. 12, o + R alpha d: the nodal points of fish of one species at a tick, world frame, metres.
// nodes[i] are those of fish first + i; all these fish must be in states and traits. The same bits
// on any instruction set. Reads the states only: ranges may run on several threads.
void nodalPoints(const MotorTables& tables,
                 std::span<const FishTraits> traits,
                 const MotionStates& states,
                 std::size_t first,
                 std::span<body::NodalPoints> nodes);

}  // namespace aquarama::motion
