// SPDX-License-Identifier: Apache-2.0
#include "common/body/face.h"

#include <algorithm>
#include <cmath>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "common/body/fin_motion.h"
#include "common/body/mouth.h"
#include "common/body/sections.h"

namespace aquarama::body {

namespace {

// Where the upper jaw slides: forward, or under a snout down.
constexpr glm::vec3 kForward{-0.97F, -0.24F, 0}, kDown{-0.5F, -0.87F, 0};
// Of the way from the joint (0) to the front of the mouth (1): where the jaw turns as one piece.
constexpr float kWholeJaw = 0.45F;
// At the corner of the lips and behind it the jaw carries them along by this share.
constexpr float kCorner = 0.6F;
// Depth below the gape, in that of the belly, from which the skin belongs to the jaw.
constexpr float kChin = 0.45F;

// How far a place is below the line from the front over the corner to the joint.
float belowGape(const config::Mouth& mouth, glm::vec2 at) {
    const bool isBehind = at.x > mouth.corner.x;
    const glm::vec2 from = isBehind ? mouth.corner : mouth.front;
    const glm::vec2 to = isBehind ? mouth.joint : mouth.corner;
    const float along = glm::clamp((at.x - from.x) / std::max(to.x - from.x, 1e-3F), 0.0F, 1.0F);
    return glm::mix(from.y, to.y, along) - at.y;
}

// How much of the opening the jaw carries a place along.
float jawShare(const config::Mouth& mouth,
               const Sections& sections,
               const CageVertex& vertex,
               float ahead) {
    const glm::vec2 at(vertex.rest);
    const float below = belowGape(mouth, at);
    const float turns = glm::smoothstep(0.0F, kWholeJaw, ahead);
    if (vertex.mouth > 0) {
        const float beforeCorner = (mouth.corner.x - at.x) / (mouth.corner.x - mouth.front.x);
        const float corner = glm::mix(kCorner, 1.0F, glm::smoothstep(0.0F, 0.5F, beforeCorner));
        return below > 0 ? corner * turns : 0;
    }
    return turns * glm::smoothstep(0.0F, kChin * sections.at(at.x).ventral, below);
}

// How much of its lift a gill cover carries a place along: most before its hind edge, at
// mid-height.
float gillShare(const config::Gill& gill, const Section& section, glm::vec3 rest) {
    const float v = rest.y / (rest.y < 0 ? section.ventral : section.dorsal);
    const float edge = gill.s - gill.bow * v * v;
    const float on = glm::smoothstep(0.55F * edge, 0.85F * edge, rest.x) *
                     (1 - glm::smoothstep(edge - 0.005F, edge + 0.012F, rest.x));
    return on * (1 - glm::smoothstep(0.65F, 0.95F, std::abs(v + 0.1F)));
}

// 0, then 1 at the middle of a breath, then 0.
float breathAt(float cycles) {
    return 0.5F - 0.5F * std::cos(kWholeTurn * cycles);
}

}  // namespace

float breathHertz(float lengthMetres) {
    const float hertz = kBreathHertz * std::pow(std::max(lengthMetres, 0.01F), kBreathPower);
    return std::floor(10 * std::clamp(hertz, kLeastBreathHertz, kMostBreathHertz) + 0.5F) / 10;
}

FacePose facePose(const FaceDrive& drive) {
    const float flat = glm::smoothstep(kBreathesDeep, kBreathesFlat, std::abs(drive.speed));
    const float cycles = breathHertz(drive.lengthMetres) * drive.seconds +
                         glm::fract(0.618F * static_cast<float>(drive.id));
    // Fins that are held across the water rest: the fish breathes deep.
    const float rests = std::max(1 - flat, drive.spread);
    const float mouth = glm::mix(kSwimmingBreath, kRestingBreath, rests) * breathAt(cycles);
    const float gill = glm::mix(kSwimmingGill, 1.0F, rests) * breathAt(cycles - kGillLag);
    return {.mouth = drive.mouth + (1 - drive.mouth) * mouth,
            .gill = glm::mix(gill, 1.0F, kGapingGill * drive.mouth)};
}

void setFacePoint(const config::Species& species,
                  const Sections& sections,
                  const CageVertex& vertex,
                  FinPoint& point) {
    const config::Mouth& mouth = species.mouth;
    const float ahead =
        glm::clamp((mouth.joint.x - vertex.rest.x) / (mouth.joint.x - mouth.front.x), 0.0F, 1.0F);
    point.side = vertex.rest.z > 0 ? 1.0F : -1.0F;
    point.q = jawShare(mouth, sections, vertex, ahead);
    point.sway = gillShare(species.gill, sections.at(vertex.rest.x), vertex.rest);
    point.arm = glm::vec3(glm::vec2(vertex.rest) - mouth.joint, 0);
    if (vertex.mouth == 0 || point.q > 0) return;
    // Of the upper lip and the roof of the mouth the arm is the way that they slide.
    point.p = glm::smoothstep(0.25F, 0.95F, ahead);
    point.arm = isUnderSnout(mouth) ? kDown : kForward;
}

glm::vec3 faceOffset(const FinStyle& style, const FinPoint& point, FacePose pose) {
    const float angle = style.gape * pose.mouth * point.q;
    const float c = std::cos(angle), s = std::sin(angle);
    const glm::vec3 turned(c * point.arm.x - s * point.arm.y, s * point.arm.x + c * point.arm.y, 0);
    const glm::vec3 jaw = point.q > 0 ? turned - glm::vec3(glm::vec2(point.arm), 0) : glm::vec3(0);
    return jaw + point.p * style.protrusion * pose.mouth * point.arm +
           glm::vec3(0, 0, point.sway * style.flare * pose.gill * point.side);
}

}  // namespace aquarama::body
