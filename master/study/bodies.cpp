// SPDX-License-Identifier: Apache-2.0
#include "master/study/bodies.h"

#include <algorithm>

#include <glm/geometric.hpp>

namespace aquarama::study {

namespace {

constexpr int kSamples = 32;  // along the shorter middle line

glm::vec3 pointOf(const Rod& rod, float behindNose) {
    return rod.origin + rod.heading * (rod.length * (kNoseAhead - behindNose));
}

float distanceTo(const Rod& rod, glm::vec3 point) {
    const float along = glm::dot(point - rod.origin, rod.heading);
    const float nearest = std::clamp(along, (kNoseAhead - 1) * rod.length, kNoseAhead * rod.length);
    return glm::distance(point, rod.origin + rod.heading * nearest);
}

bool mayTouch(const Rod& a, const Rod& b, float room) {
    const float reach = (1 - kNoseAhead) * (a.length + b.length) + room;
    const glm::vec3 apart = b.origin - a.origin;
    return glm::dot(apart, apart) < reach * reach;
}

}  // namespace

void rodsOf(const fish::FishView& view, std::span<const float> halfWidths, std::vector<Rod>& rods) {
    rods.resize(view.size());
    for (std::size_t fish = 0; fish < view.size(); ++fish) {
        const float length = view.shows(fish, fish::kAway) ? 0.0F : view.fish[fish].length;
        rods[fish] = {
            view.position(fish), view.heading(fish), length, length * halfWidths[view.kind[fish]]};
    }
}

float distanceBetween(const Rod& a, const Rod& b) {
    float nearest = distanceTo(b, pointOf(a, 0));
    for (int i = 1; i <= kSamples; ++i)
        nearest = std::min(nearest, distanceTo(b, pointOf(a, static_cast<float>(i) / kSamples)));
    return nearest;
}

float overlapOf(const Rod& a, const Rod& b) {
    if (a.length == 0 || b.length == 0) return 0;
    const float room = a.halfWidth + b.halfWidth;
    if (!mayTouch(a, b, room)) return 0;
    const Rod& shorter = a.length < b.length ? a : b;
    const Rod& other = a.length < b.length ? b : a;
    int inside = 0;
    for (int i = 0; i <= kSamples; ++i)
        inside += distanceTo(other, pointOf(shorter, static_cast<float>(i) / kSamples)) < room;
    return static_cast<float>(inside) / (kSamples + 1);
}

}  // namespace aquarama::study
