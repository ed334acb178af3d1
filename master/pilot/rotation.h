// SPDX-License-Identifier: Apache-2.0
// Rotations by exact arithmetic: two machines' libm do not agree to the bit. Radians.
#pragma once

#include <cmath>

#include <glm/vec3.hpp>

#include "common/motion/orientation.h"
#include "common/place/angle.h"

namespace aquarama::pilot {

struct SineCosine {
    float sine = 0;
    float cosine = 1;
};

// Of angles up to some turns, within 1e-6: Taylor's series about the nearest quarter turn.
[[nodiscard]] inline SineCosine sineAndCosine(float radians) {
    const float quarters = motion::roundToEven(radians * (2 / place::kPi));
    const float x = radians - quarters * (place::kPi / 2);
    const float s = x * x;
    const float sine = x * (1 - s / 6 * (1 - s / 20 * (1 - s / 42)));
    const float cosine = 1 - s / 2 * (1 - s / 12 * (1 - s / 30 * (1 - s / 56)));
    switch (static_cast<int>(quarters) & 3) {
        case 0:
            return {sine, cosine};
        case 1:
            return {cosine, -sine};
        case 2:
            return {-sine, -cosine};
        default:
            return {-cosine, sine};
    }
}

// The same angle, -pi to pi.
[[nodiscard]] inline float wrapped(float radians) {
    return radians - motion::roundToEven(radians / (2 * place::kPi)) * (2 * place::kPi);
}

// How the submarine stands in the world. Without any it looks along -z.
struct Attitude {
    float yaw = 0;    // about the world's up, to the left
    float pitch = 0;  // nose up
    float roll = 0;   // right side up
};

[[nodiscard]] inline motion::Quaternion worldFromBody(const Attitude& attitude) {
    const auto [ys, yc] = sineAndCosine(attitude.yaw / 2);
    const auto [ps, pc] = sineAndCosine(attitude.pitch / 2);
    const auto [rs, rc] = sineAndCosine(attitude.roll / 2);
    return motion::normalised(motion::Quaternion{yc, 0, ys, 0} * motion::Quaternion{pc, ps, 0, 0} *
                              motion::Quaternion{rc, 0, 0, rs});
}

// Along the nose; to the right, level.
[[nodiscard]] inline glm::vec3 noseOf(const Attitude& attitude) {
    const auto [ys, yc] = sineAndCosine(attitude.yaw);
    const auto [ps, pc] = sineAndCosine(attitude.pitch);
    return {-ys * pc, ps, -yc * pc};
}
[[nodiscard]] inline glm::vec3 rightOf(const Attitude& attitude) {
    const auto [ys, yc] = sineAndCosine(attitude.yaw);
    return {yc, 0, -ys};
}

}  // namespace aquarama::pilot
