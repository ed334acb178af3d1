// The school as the wire has it (FishRecord of common/motion/motion_state.h, 40 bytes): before and
// after a tick, and where each fish is between them. present() of common/motion/reconstruct.h is the
// reference. Gives place in world metres, length in metres, rotation as a quaternion from body to
// world, phases in cycles.
#ifndef FISH_RECORD_GLSL
#define FISH_RECORD_GLSL
#include "record_units.h"
#include "shader_interface.h"

// Five words of two numbers a fish: x, y; z, the low orientation; the high one, phases; segments, speed
// in 24 bits and spread in 8; warp, mouth and gaze, skin.
const uint kWords = 5u;
layout(std430, binding = kBeforeStorage) readonly buffer Before { uvec2 before[]; };
layout(std430, binding = kAfterStorage) readonly buffer After { uvec2 after[]; };
layout(std430, binding = kTraitsStorage) readonly buffer Traits { uvec2 traits[]; };  // id, length in millimetres
layout(location = kFractionLocation) uniform float fraction;                             // of the way to `after`

float lengthMetresOf(uint i) { return float(traits[i].y) * 0.001; }

// Body lengths a second; backwards is negative.
float speedOf(uint i) {
    ivec2 units = ivec2(before[kWords * i + 3u].y, after[kWords * i + 3u].y) << 8 >> 8;
    return mix(float(units.x), float(units.y), fraction) / kSpeedUnitsPerBodyLength;
}

// Of the pectoral fins, 0 to 1.
float spreadOf(uint i) {
    uvec2 spread = uvec2(before[kWords * i + 3u].y, after[kWords * i + 3u].y) >> 24;
    return mix(float(spread.x), float(spread.y), fraction) / kMostSpread;
}

// How far the mouth is open, 0 to 1.
float mouthOf(uint i) {
    uvec2 mouth = uvec2(before[kWords * i + 4u].x, after[kWords * i + 4u].x) >> 16 & 255u;
    return mix(float(mouth.x), float(mouth.y), fraction) / 255.0;
}

// directionOf() of common/motion/gaze.h.
vec3 gazeDirection(uint bits) {
    vec2 angles = vec2(ivec2(bits << 28, bits << 24) >> 28) * vec2(0.39269908, 0.19634954);
    return vec3(cos(angles.y) * cos(angles.x), sin(angles.y), cos(angles.y) * sin(angles.x));
}

// Where the fish looks: body frame, no longer than 1.
vec3 gazeOf(uint i) {
    return mix(gazeDirection(before[kWords * i + 4u].x >> 24), gazeDirection(after[kWords * i + 4u].x >> 24), fraction);
}

// The number of the drawing that it wears; 0: none.
uint skinOf(uint i) { return after[kWords * i + 4u].y; }

// Whether the fish is away at one of the ticks, and so not drawn.
bool isAway(uint i) {
    return int(before[kWords * i].y) < kAwayBelow || int(after[kWords * i].y) < kAwayBelow;
}

vec3 placeMetresOf(uint i) {
    ivec3 from = ivec3(before[kWords * i], before[kWords * i + 1u].x);
    ivec3 to = ivec3(after[kWords * i], after[kWords * i + 1u].x);
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
    vec4 from = unpackRotation(before[kWords * i + 1u].y, before[kWords * i + 2u].x);
    vec4 to = unpackRotation(after[kWords * i + 1u].y, after[kWords * i + 2u].x);
    if (dot(from, to) < 0.0) to = -to;
    return normalize(from * (1.0 - fraction) + to * fraction);
}

struct Motion {
    float phase, fromPhase, warpWeight;
    uint action, fromAction;
};

uint actionOf(uint segment) {
    if (segment < kFirstTurn) return segment;
    if (segment < kFirstStartSegment) return kFirstTurn + (segment - kFirstTurn) / kTurnSegments;
    return kFirstStart + (segment - kFirstStartSegment) / kStartSegments;
}

float phaseBetween(uint from, uint to) {
    float phase = float(from) + fraction * float(to - from & 65535u);
    return (phase < 65536.0 ? phase : phase - 65536.0) * kPhaseUnit;
}

float weightOf(uint warp) { return float((warp & 255u) + 1u) / float((warp >> 8 & 255u) + 1u); }

// Phase, segment and warp between the ticks. A warp that has just begun fades in from the segment
// that was left.
Motion motionOf(uint i) {
    uint phases = after[kWords * i + 2u].y, segments = after[kWords * i + 3u].x, warp = after[kWords * i + 4u].x;
    uint lastPhase = before[kWords * i + 2u].y & 65535u, lastSegment = before[kWords * i + 3u].x & 65535u;
    uint lastWarp = before[kWords * i + 4u].x, segment = segments & 65535u;
    Motion m = Motion(float(phases & 65535u) * kPhaseUnit, float(phases >> 16) * kPhaseUnit, weightOf(warp),
                      actionOf(segment), actionOf(segments >> 16));
    bool wasWarping = (lastWarp & 255u) != (lastWarp >> 8 & 255u);
    bool hasJustLeft = (warp & 255u) == 0u && lastSegment == segments >> 16 && lastPhase == phases >> 16 &&
                       lastSegment != segment && !wasWarping;
    if (hasJustLeft) {
        m.warpWeight *= fraction;
    } else if (lastSegment == segment) {
        m.phase = phaseBetween(lastPhase, phases & 65535u);
        m.warpWeight = mix(weightOf(lastWarp), weightOf(warp), fraction);
    }
    return m;
}
#endif
