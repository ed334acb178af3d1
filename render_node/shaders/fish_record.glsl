// The school as the wire has it (FishRecord of common/motion/motion_state.h, 32 bytes): before and
// after a tick, and where each fish is between them. present() of common/motion/reconstruct.h is the
// reference. Gives place in world metres, length in metres, rotation as a quaternion from body to
// world, phases in cycles.
#ifndef FISH_RECORD_GLSL
#define FISH_RECORD_GLSL
#include "record_units.h"
#include "shader_interface.h"

// Two words of four numbers a fish: place and the low orientation; the high one, phases, segments
// and warp, speed in 24 bits and spread in 8.
layout(std430, binding = kBeforeStorage) readonly buffer Before { uvec4 before[]; };
layout(std430, binding = kAfterStorage) readonly buffer After { uvec4 after[]; };
layout(std430, binding = kTraitsStorage) readonly buffer Traits { uvec2 traits[]; };  // id, length in millimetres
layout(location = kFractionLocation) uniform float fraction;                             // of the way to `after`

float lengthMetresOf(uint i) { return float(traits[i].y) * 0.001; }

// Body lengths a second; backwards is negative.
float speedOf(uint i) {
    ivec2 units = ivec2(before[2u * i + 1u].w, after[2u * i + 1u].w) << 8 >> 8;
    return mix(float(units.x), float(units.y), fraction) / kSpeedUnitsPerBodyLength;
}

// Of the pectoral fins, 0 to 1.
float spreadOf(uint i) {
    uvec2 spread = uvec2(before[2u * i + 1u].w, after[2u * i + 1u].w) >> 24;
    return mix(float(spread.x), float(spread.y), fraction) / kMostSpread;
}

// Whether the fish is away at one of the ticks, and so not drawn.
bool isAway(uint i) {
    return int(before[2u * i].y) < kAwayBelow || int(after[2u * i].y) < kAwayBelow;
}

vec3 placeMetresOf(uint i) {
    ivec3 from = ivec3(before[2u * i].xyz), to = ivec3(after[2u * i].xyz);
    return (vec3(from) + fraction * vec3(to - from)) * kPositionUnitMetres;
}

// The smallest three components of a unit quaternion, 20 bits each; the largest is positive.
vec4 unpackRotation(uint low, uint high) {
    uvec3 bits = uvec3(low, (low >> 20) | (high << 12), high >> 8);
    vec3 abc = vec3(ivec3(bits << 12) >> 12) * kOrientationUnit;
    float most = sqrt(max(1.0 - dot(abc, abc), 0.0));
    uint largest = (high >> 28) & 3u;  // of w, x, y, z
    if (largest == 0u) return vec4(abc, most);
    if (largest == 1u) return vec4(most, abc.yz, abc.x);
    if (largest == 2u) return vec4(abc.y, most, abc.z, abc.x);
    return vec4(abc.yz, most, abc.x);
}

// Normalised linear interpolation by the shorter way.
vec4 rotationOf(uint i) {
    vec4 from = unpackRotation(before[2u * i].w, before[2u * i + 1u].x);
    vec4 to = unpackRotation(after[2u * i].w, after[2u * i + 1u].x);
    if (dot(from, to) < 0.0) to = -to;
    return normalize(from * (1.0 - fraction) + to * fraction);
}

struct Motion {
    float phase, fromPhase, warpWeight;
    uint action, fromAction;
};

uint actionOf(uint segment) {
    return segment < kFirstTurn ? segment : kFirstTurn + (segment - kFirstTurn) / kTurnSegments;
}

float phaseBetween(uint from, uint to) {
    float phase = float(from) + fraction * float(to - from & 65535u);
    return (phase < 65536.0 ? phase : phase - 65536.0) * kPhaseUnit;
}

float weightOf(uint motion) { return float((motion >> 16 & 255u) + 1u) / float((motion >> 24) + 1u); }

// Phase, segment and warp between the ticks. A warp that has just begun fades in from the segment
// that was left.
Motion motionOf(uint i) {
    uvec2 from = before[2u * i + 1u].yz, to = after[2u * i + 1u].yz;
    uint segment = to.y & 255u, fromSegment = to.y >> 8 & 255u, lastSegment = from.y & 255u;
    Motion m = Motion(float(to.x & 65535u) * kPhaseUnit, float(to.x >> 16) * kPhaseUnit,
                      weightOf(to.y), actionOf(segment), actionOf(fromSegment));
    bool wasWarping = (from.y >> 16 & 255u) != from.y >> 24;
    bool hasJustLeft = (to.y >> 16 & 255u) == 0u && lastSegment == fromSegment &&
                       (from.x & 65535u) == to.x >> 16 && lastSegment != segment && !wasWarping;
    if (hasJustLeft) {
        m.warpWeight *= fraction;
    } else if (lastSegment == segment) {
        m.phase = phaseBetween(from.x & 65535u, to.x & 65535u);
        m.warpWeight = mix(weightOf(from.y), weightOf(to.y), fraction);
    }
    return m;
}
#endif
