// SPDX-License-Identifier: Apache-2.0
#include "master/capture/control/body_angles.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "master/capture/dynamics/body_frame.h"

namespace aquarama::capture {

namespace {

double mixAngles(double from, double to, double share) {
    return from + share * std::remainder(to - from, 2 * std::numbers::pi);
}

}  // namespace

BodyAngles bodyAnglesOf(const FishState& state) {
    const glm::dmat3 worldFromBody = frameOf(state.positions).worldFromBody;
    const glm::dvec3& x = worldFromBody[0];
    return {.headingRadians = std::atan2(-x.z, x.x),
            .pitchRadians = std::asin(std::clamp(x.y, -1.0, 1.0)),
            .rollRadians = std::atan2(worldFromBody[2].y, worldFromBody[1].y)};
}

BodyAngles sense(const BodyAngles& before, const FishState& state, double share) {
    const BodyAngles now = bodyAnglesOf(state);
    return {.headingRadians = mixAngles(before.headingRadians, now.headingRadians, share),
            .pitchRadians = std::lerp(before.pitchRadians, now.pitchRadians, share),
            .rollRadians = now.rollRadians};
}

}  // namespace aquarama::capture
