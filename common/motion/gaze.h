// SPDX-License-Identifier: Apache-2.0
// Where a fish looks, in a byte: low four bits to the right, in steps of 22.5 degrees, high four
// bits up, in steps of 11.25 degrees, both in two's complement. Zero is straight ahead; every byte
// is a direction.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

namespace aquarama::motion {

// Of a step: radians to the right, and up.
inline constexpr float kGazeAside = 0.39269908F, kGazeUp = 0.19634954F;

// Four bits as a number from -8 to 7.
[[nodiscard]] constexpr int signedNibble(unsigned bits) {
    return static_cast<int>((bits & 15U) ^ 8U) - 8;
}

// The number of steps of an angle whose sine and cosine are in this proportion; cosine >= 0, from 0
// to
// 8. Comparisons only, so that all machines agree. tangents: of the middles between two steps.
template <std::size_t n>
[[nodiscard]] constexpr int stepsOf(const std::array<float, n>& tangents,
                                    float sine,
                                    float cosine) {
    int steps = 0;
    for (const float tangent : tangents) steps += sine > tangent * cosine ? 1 : 0;
    return steps;
}

// direction: in the body frame (x anterior, y dorsal, z right), of any length.
[[nodiscard]] inline std::uint8_t gazeTowards(glm::vec3 direction) {
    // Tangents of odd multiples of 11.25 and of 5.625 degrees.
    constexpr std::array kAside{0.198912367F, 0.668178638F, 1.49660576F, 5.02733949F};
    constexpr std::array kUp{0.0984914034F,
                             0.303346684F,
                             0.534511136F,
                             0.820678791F,
                             1.21850353F,
                             1.87086841F,
                             3.29655821F,
                             10.1531704F};
    const float right = direction.z < 0 ? -direction.z : direction.z;
    const float ahead = direction.x < 0 ? -direction.x : direction.x;
    const float high = direction.y < 0 ? -direction.y : direction.y;
    int aside = stepsOf(kAside, right, ahead);
    if (direction.x < 0) aside = 8 - aside;
    if (direction.z < 0) aside = -aside;
    const int steps = stepsOf(kUp, high, std::sqrt(right * right + ahead * ahead));
    const int up = direction.y < 0 ? -steps : std::min(steps, 7);
    return static_cast<std::uint8_t>((static_cast<unsigned>(aside) & 15U) |
                                     (static_cast<unsigned>(up) & 15U) << 4U);
}

// A unit vector of the body frame.
[[nodiscard]] inline glm::vec3 directionOf(std::uint8_t gaze) {
    const float aside = kGazeAside * static_cast<float>(signedNibble(gaze));
    const float up = kGazeUp * static_cast<float>(signedNibble(gaze >> 4U));
    return {std::cos(up) * std::cos(aside), std::sin(up), std::cos(up) * std::sin(aside)};
}

// A gaze after a tick: a step nearer to the wanted one, aside by the shorter way.
[[nodiscard]] constexpr std::uint8_t gazeAfter(unsigned gaze, unsigned wanted) {
    const int aside = std::clamp(signedNibble(wanted - gaze), -1, 1);
    const int up = std::clamp(signedNibble(wanted >> 4U) - signedNibble(gaze >> 4U), -1, 1);
    return static_cast<std::uint8_t>(((gaze + static_cast<unsigned>(aside)) & 15U) |
                                     (((gaze >> 4U) + static_cast<unsigned>(up)) & 15U) << 4U);
}

}  // namespace aquarama::motion
