// SPDX-License-Identifier: Apache-2.0
#include "master/behaviour/patrol.h"

#include <algorithm>
#include <array>

#include "common/base/random_streams.h"
#include "common/base/units.h"
#include "common/place/place.h"
#include "master/surroundings/surroundings.h"

namespace aquarama::behaviour {

namespace {

// The border is divided into stretches by the direction from the middle of the water.
constexpr std::size_t kStretches = 12;
constexpr std::array<glm::vec2, kStretches> kDirections{{{1, 0},
                                                         {0.8660254F, 0.5F},
                                                         {0.5F, 0.8660254F},
                                                         {0, 1},
                                                         {-0.5F, 0.8660254F},
                                                         {-0.8660254F, 0.5F},
                                                         {-1, 0},
                                                         {-0.8660254F, -0.5F},
                                                         {-0.5F, -0.8660254F},
                                                         {0, -1},
                                                         {0.5F, -0.8660254F},
                                                         {0.8660254F, -0.5F}}};
// A predator keeps to a stretch for so long.
constexpr std::uint64_t kTicksOfStretch = std::uint64_t{100} * 60;
// Share of the half extent of the water at which it patrols: by day, and when it is most active.
constexpr float kByDay = 0.85F;
constexpr float kActive = 0.65F;
// Its height, as a share of the half height of the water: by day and when it is most active, and
// how far it rises and sinks about that.
constexpr float kHighByDay = 0.6F;
constexpr float kHighActive = -0.35F;
constexpr float kRises = 0.15F;
constexpr std::uint64_t kTicksOfHeight = std::uint64_t{25} * 60;
// Half length of an oval, drawn, and half width; both no more than a share of the half extent.
constexpr float kShortestHalf = 3.2F;
constexpr float kLongestHalf = 5.8F;
constexpr float kHalfWidth = 2;
constexpr float kMostOfWater = 0.4F;
// From farther than so many half extents of the oval the fish goes there along the border.
constexpr float kFarFromOval = 2;
// A structure at this distance makes a stretch half reef, half open water.
constexpr float kHalfReefMetres = 4;
// Cosine and sine of 40 degrees.
constexpr float kAheadCosine = 0.766F;
constexpr float kAheadSine = 0.643F;

// Turned in plan by 40 degrees: from x towards z where `sense` is 1, back where it is -1.
glm::vec2 ahead(glm::vec2 direction, float sense) {
    return {direction.x * kAheadCosine - direction.y * kAheadSine * sense,
            direction.x * kAheadSine * sense + direction.y * kAheadCosine};
}

glm::vec2 directionInPlan(glm::vec2 offset) {
    const glm::vec3 direction = place::directionOf({offset.x, 0, offset.y}, {1, 0, 0});
    return {direction.x, direction.z};
}

// The stretch of the border where a predator is now. By day one where the reef is far is likely, at
// dusk and by night one where it is near.
std::size_t stretchOf(const Environment& environment, std::uint32_t own, float active) {
    const surroundings::Surroundings& around = *environment.surroundings;
    const place::Region& water = around.obstacles.water;
    std::array<float, kStretches> weights{};
    float sum = 0;
    for (std::size_t i = 0; i < kStretches; ++i) {
        const glm::vec2 direction = kDirections[i];
        const glm::vec3 place =
            water.centre + glm::vec3{direction.x, 0, direction.y} * water.halfExtent * kByDay;
        float nearest = kHalfReefMetres;
        for (std::size_t s = 0; s < around.structures.size(); ++s) {
            const glm::vec3 from = around.structures[s].crown - place;
            const float distance = place::lengthOf({from.x, 0, from.z});
            nearest = s == 0 ? distance : std::min(nearest, distance);
        }
        const float far =
            nearest * nearest / (nearest * nearest + kHalfReefMetres * kHalfReefMetres);
        const float liked = far + (1 - 2 * far) * active;
        weights[i] = liked * liked * liked * liked;
        sum += weights[i];
    }
    const std::uint64_t now = (environment.tick.value + own % kTicksOfStretch) / kTicksOfStretch;
    float left = sum * unitOf(hashOf(own, static_cast<std::uint32_t>(now)));
    for (std::size_t i = 0; i < kStretches; ++i) {
        left -= weights[i];
        if (left <= 0) return i;
    }
    return kStretches - 1;
}

float heightOf(const Environment& environment, std::uint32_t own, float active) {
    const place::Region& water = environment.surroundings->obstacles.water;
    const std::uint64_t now = (environment.tick.value + own % kTicksOfHeight) / kTicksOfHeight;
    const float rises =
        kRises * signedUnitOf(hashOf(hashOf(own, 1), static_cast<std::uint32_t>(now)));
    const float high = kHighByDay + (kHighActive - kHighByDay) * active;
    return water.centre.y + water.halfExtent.y * (high + rises);
}

}  // namespace

glm::vec3 patrolGoal(const Environment& environment, std::uint32_t fish, glm::vec3 position) {
    const place::Region& water = environment.surroundings->obstacles.water;
    const std::uint32_t own = hashOf(environment.seed, Stream::Beats, fish);
    const float active = surroundings::huntersActive(*environment.surroundings);
    const glm::vec2 direction = kDirections[stretchOf(environment, own, active)];
    const glm::vec2 half{water.halfExtent.x, water.halfExtent.z};
    const glm::vec2 border = half * (kByDay + (kActive - kByDay) * active);
    const glm::vec2 middle{water.centre.x, water.centre.z};
    const glm::vec2 from = glm::vec2{position.x, position.z} - middle;
    const float height = heightOf(environment, own, active);
    // The oval touches the border from within.
    const float least = std::min(half.x, half.y);
    const float width = std::min(kHalfWidth, kMostOfWater * least);
    const float length =
        std::clamp(kShortestHalf + (kLongestHalf - kShortestHalf) * unitOf(hashOf(own, 2)),
                   width,
                   2 * least * kMostOfWater);
    const glm::vec2 outwards = directionInPlan(direction * border);
    const glm::vec2 along{-outwards.y, outwards.x};
    const glm::vec2 centre = direction * border - outwards * width;
    const glm::vec2 off = from - centre;
    const glm::vec2 at{(off.x * along.x + off.y * along.y) / length,
                       (off.x * outwards.x + off.y * outwards.y) / width};
    const auto inWater = [&](glm::vec2 plan) {
        const glm::vec2 goal = middle + glm::clamp(plan, -border, border);
        return glm::vec3{goal.x, height, goal.y};
    };
    if (at.x * at.x + at.y * at.y > kFarFromOval * kFarFromOval) {
        const glm::vec2 here = directionInPlan(from / border);
        const bool left = here.x * direction.y - here.y * direction.x > 0;
        return inWater(ahead(here, left ? 1.0F : -1.0F) * border);
    }
    const glm::vec2 next = ahead(directionInPlan(at), (own & 1U) != 0 ? 1.0F : -1.0F);
    return inWater(centre + along * (next.x * length) + outwards * (next.y * width));
}

}  // namespace aquarama::behaviour
