// SPDX-License-Identifier: Apache-2.0
// How the fins of a species move beside its body, as shaders read it (fish_fins.glsl, std430).
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace aquarama::body {

// Of a species; angles in radians, speeds in body lengths a second. Axes and arms are of the right
// side: tailwards, up, away from the body. The left side is its mirror image.
struct FinStyle {
    glm::vec3 hinge{};      // of the pectoral fin: about it the fin opens
    float open = 0;         // from the rest angle to the middle of the stroke
    glm::vec3 stroke{};     // about it the fin beats
    float fold = 0;         // from the rest angle to the flank
    glm::vec3 ray{};        // the fin's own axis, about which it feathers
    float strokeAngle = 0;  // to either side
    float featherAngle = 0, trimAngle = 0;
    float rowHertz = 0;
    float alternateBelow = 0, foldAbove = 0;
    float pelvicFold = 0;
    float swimRipple = 0, swimWaves = 0;  // of the median fins: in ray lengths, along the fin
    float hoverRipple = 0, hoverWaves = 0, hoverHertz = 0;
    float opposed = 0;  // phase of the anal fin against the dorsal
    float cupping = 0;
    float padding[3] = {0, 0, 0};  // to whole vectors
};
static_assert(sizeof(FinStyle) == 112);

// Of a control point.
struct FinPoint {
    glm::vec3 arm{};         // on a paired fin: from the middle of its root, at rest
    float side = 0;          // right 1, left -1
    float p = 0, q = 0;      // along the fin's base, and from base to edge
    float sway = 0;          // on a median fin: ray length * flex * q^1.5, body lengths
    std::uint32_t part = 0;  // CagePart; the body's and those of a fin's root stay where they are
};
static_assert(sizeof(FinPoint) == 32);

struct FinTable {
    FinStyle style;
    std::vector<FinPoint> points;  // one a control point
};

}  // namespace aquarama::body
