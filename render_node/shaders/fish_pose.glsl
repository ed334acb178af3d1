// A fish's control points from the recorded ones (eq. 13), in its body frame, body lengths.
#ifndef FISH_POSE_GLSL
#define FISH_POSE_GLSL
#include "fish_school.glsl"

const uint kControlPoints = 426u;
const uint kPhases = 64u;
const uint kActions = 8u;
// 3 x 16 bits a point, body lengths.
layout(std430, binding = 1) readonly buffer Recorded { uvec2 recorded[]; };

vec3 recordedPoint(uint segment, uint phase, uint point) {
    uvec2 bits = recorded[(segment * kPhases + phase) * kControlPoints + point];
    return vec3(unpackSnorm2x16(bits.x), unpackSnorm2x16(bits.y).x);
}

vec3 pointAt(uint segment, float phase, uint point) {
    float sampled = phase * float(kPhases);
    uint before = uint(floor(sampled)) % kPhases;
    uint after = (before + 1u) % kPhases;
    return mix(recordedPoint(segment, before, point), recordedPoint(segment, after, point),
               fract(sampled));
}

// The segments of all species lie one behind the other.
vec3 controlPointOf(Fish self, uint i) {
    uint first = self.species * kActions;
    vec3 point = pointAt(first + self.segment, self.phase, i);
    if (self.warpWeight < 1.0)
        point = mix(pointAt(first + self.fromSegment, self.fromPhase, i), point, self.warpWeight);
    return point;
}
#endif
