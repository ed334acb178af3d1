// SPDX-License-Identifier: Apache-2.0
#include "common/body/mouth.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace aquarama::body {

namespace {

// A front behind this station lies under a snout.
constexpr float kSnout = 0.015F;
// Instead of kCageGrowth along the lips, which are creased.
constexpr float kLipGrow = 1.02F;
// Half of the gap between the lips of a shut mouth, and of that between roof and floor; in the
// width of a lip.
constexpr float kGap = 0.25F, kDeepGap = 1.0F;
// Along the line from front (0) to corner (1): the steps of a lip. The last is beyond the corner,
// as the smooth loop falls short of its cage there.
constexpr std::array<float, 3> kAlong{0, 0.36F, 1.06F};
constexpr float kDeep = 1.15F;  // of the bottom of the mouth
// Of a snout over the mouth: the stations of its rim, in the middle and a step aside.
constexpr float kRim = 0.012F;

float shareOf(const Section& section, float y) {
    return y / (y < 0 ? section.ventral : section.dorsal);
}

}  // namespace

bool isUnderSnout(const config::Mouth& mouth) {
    return mouth.front.x > kSnout;
}

MouthShape::MouthShape(const config::Mouth& mouth, const Sections& sections)
    : mouth_(mouth), sections_(sections), isUnderSnout_(isUnderSnout(mouth)) {
    const float corner = mouth.corner.x;
    const float behind = 0.010F + 0.10F * (corner - mouth.front.x);
    const float back = isUnderSnout_ ? 0.0F : 0.008F;
    // The columns beside the corner are at 0.8 of the way from the back to the flank.
    ring_ = {back,
             (corner + behind - 0.2F * back) / (isUnderSnout_ ? 0.95F : 0.8F),
             isUnderSnout_ ? mouth.front.x + 0.028F : 0.008F + 0.16F * corner};
    cornerShare_ = glm::clamp(shareOf(sections.at(corner), mouth.corner.y), -0.75F, 0.5F);
}

glm::vec2 MouthShape::onLine(float along) const {
    return glm::mix(mouth_.front, mouth_.corner, along);
}

float MouthShape::widthAt(glm::vec2 at) const {
    const Section section = sections_.at(at.x);
    return section.widthAt(glm::clamp(shareOf(section, at.y), -0.98F, 0.98F));
}

glm::vec3 MouthShape::onLip(int step, float side) const {
    assert(step >= 0);
    assert(step <= 5);
    const bool isUpper = step < 3;
    const auto k = static_cast<std::size_t>(isUpper ? step : 5 - step);
    const glm::vec2 line = glm::normalize(mouth_.corner - mouth_.front);
    const glm::vec2 up = glm::vec2(-line.y, line.x) * (kGap * mouth_.lip);
    glm::vec2 at = onLine(kAlong.at(k));
    float width = kLipGrow * widthAt(at);
    if (k == 0) {
        const float beside = widthAt(onLine(kAlong[1]));
        width = isUnderSnout_ ? 0.4F * beside
                              : std::min(0.4F * beside, 0.9F * sections_.at(at.x).halfWidth);
    }
    at += isUpper ? up : -up;
    return {std::max(at.x, 0.0F), at.y, side * width};
}

glm::vec3 MouthShape::inside(int row, float side) const {
    const glm::vec2 at = onLine(kDeep) + glm::vec2(0.004F, 0);
    const float up = (row == 0 ? kDeepGap : -kDeepGap) * mouth_.lip;
    return {at.x, at.y + up, side * 0.45F * widthAt(mouth_.corner)};
}

float MouthShape::shareBeside(int step) const {
    return step < 3 ? cornerShare_ + 0.30F : std::max(cornerShare_ - 0.30F, -0.80F);
}

glm::vec3 MouthShape::aroundLips(int step, float side) const {
    assert(step >= 0);
    assert(step <= 5);
    // In the middle of back and belly, a step aside of it, beside the corner.
    constexpr std::array<float, 6> kDown{0, 0.35F, 0.8F, 1.2F, 1.65F, 2};
    const float down = kDown.at(static_cast<std::size_t>(step));
    float s =
        down < 1 ? glm::mix(ring_[0], ring_[1], down) : glm::mix(ring_[1], ring_[2], down - 1);
    float share = step < 3 ? shareBeside(2) : shareBeside(3);
    if (step == 1 || step == 4) share = glm::mix(share, step == 1 ? 1.0F : -1.0F, 0.55F);
    if (isUnderSnout_ && step == 1) s = kRim;
    if (isUnderSnout_ && step == 2) s = 0.9F * mouth_.corner.x;
    if (isUnderSnout_ && step < 3) share = 0;
    const Section section = sections_.at(s);
    if (step == 0 || step == 5) {
        const float y = isUnderSnout_ && step == 0 ? 0.0F : section.heightAt(step == 0 ? 1 : -1);
        return {s, y, side * std::min(0.006F, 0.45F * section.halfWidth)};
    }
    return {s, kCageGrowth * section.heightAt(share), side * kCageGrowth * section.widthAt(share)};
}

}  // namespace aquarama::body
