// SPDX-License-Identifier: Apache-2.0
#include "common/place/noise.h"

#include <algorithm>

#include "common/units/hash.h"

namespace aquarama::place {

namespace {

constexpr float kFarthestCell = 1.0e6F;  // keeps the conversion to integers defined for any input

int cellOf(float x) {
    const int towardsZero = static_cast<int>(x);
    return x < static_cast<float>(towardsZero) ? towardsZero - 1 : towardsZero;
}

float smooth(float t) {
    return t * t * t * (t * (t * 6.0F - 15.0F) + 10.0F);
}

float lattice(std::uint32_t seed, int x, int y) {
    const std::uint32_t column = hashOf(seed, static_cast<std::uint32_t>(x));
    return signedUnitOf(hashOf(column, static_cast<std::uint32_t>(y)));
}

float mixed(float a, float b, float t) {
    return a + (b - a) * t;
}

}  // namespace

float valueNoise(std::uint32_t seed, glm::vec2 place) {
    const float x = std::clamp(place.x, -kFarthestCell, kFarthestCell);
    const float y = std::clamp(place.y, -kFarthestCell, kFarthestCell);
    const int cellX = cellOf(x);
    const int cellY = cellOf(y);
    const float u = smooth(x - static_cast<float>(cellX));
    const float v = smooth(y - static_cast<float>(cellY));
    const float near = mixed(lattice(seed, cellX, cellY), lattice(seed, cellX + 1, cellY), u);
    const float far =
        mixed(lattice(seed, cellX, cellY + 1), lattice(seed, cellX + 1, cellY + 1), u);
    return mixed(near, far, v);
}

float fractalNoise(std::uint32_t seed, glm::vec2 place, int octaves) {
    float sum = 0.0F;
    float height = 1.0F;
    for (int octave = 0; octave < octaves; ++octave) {
        sum += height * valueNoise(hashOf(seed, static_cast<std::uint32_t>(octave)), place);
        // The lattices of two octaves must not meet at the origin: all would be flat there.
        place = glm::vec2{place.x * 2.0F + 17.31F, place.y * 2.0F - 9.73F};
        height *= 0.5F;
    }
    return sum;
}

}  // namespace aquarama::place
