// A fish's control points from the recorded ones (eq. 13), and its fins moved beside them; in its body
// frame, body lengths. common/motion/living_cage.h is the reference.
#ifndef FISH_POSE_GLSL
#define FISH_POSE_GLSL
#include "frame_uniforms.h"
#include "fish_data.glsl"
#include "fish_fins.glsl"

const uint kControlPoints = 426u;
const uint kPhases = 64u;
// 3 x 16 bits a point, body lengths; then its heading, half turns.
layout(std430, binding = 1) readonly buffer Recorded { uvec2 recorded[]; };

struct FinTable {
    FinStyle style;
    FinPoint points[kControlPoints];
};
layout(std430, binding = 9) readonly buffer Fins { FinTable finTables[]; };

struct Posed {
    vec3 place;
    float heading;
    float drift;  // to the right, body lengths in a radian of the beat
};

vec4 recordedPoint(uint segment, uint phase, uint point) {
    uvec2 bits = recorded[(segment * kPhases + phase) * kControlPoints + point];
    return vec4(unpackSnorm2x16(bits.x), unpackSnorm2x16(bits.y));
}

Posed posedAt(uint segment, float phase, uint point) {
    float sampled = phase * float(kPhases);
    uint before = uint(floor(sampled)) % kPhases;
    vec4 from = recordedPoint(segment, before, point);
    vec4 to = recordedPoint(segment, (before + 1u) % kPhases, point);
    vec4 here = mix(from, to, fract(sampled));
    float heading = here.w * 0.5 * kWholeTurn;
    vec3 right = vec3(sin(heading), 0.0, cos(heading));
    return Posed(here.xyz, heading, dot(to.xyz - from.xyz, right) * float(kPhases) / kWholeTurn);
}

// How far a segment is a turn to the left, to the right. Actions of common/motion/repertoire.h.
vec2 turnOf(uint segment) {
    const float kGradual = 0.4;
    return vec2(segment == 3u ? kGradual : segment == 4u ? 1.0 : 0.0,
                segment == 5u ? kGradual : segment == 6u ? 1.0 : 0.0);
}

FinDrive finDriveOf(Fish self) {
    return FinDrive(eyeAndTime.w, self.speed, rotate(self.rotation, vec3(1.0, 0.0, 0.0)).y,
                    mix(turnOf(self.fromSegment), turnOf(self.segment), self.warpWeight),
                    0.37 * float(self.id), self.phase, self.fromPhase, self.warpWeight);
}

vec3 controlPointOf(Fish self, uint i) {
    Posed pose = posedAt(self.segment, self.phase, i);
    if (self.warpWeight < 1.0) {
        Posed from = posedAt(self.fromSegment, self.fromPhase, i);
        pose.place = mix(from.place, pose.place, self.warpWeight);
        pose.heading = mix(from.heading, pose.heading, self.warpWeight);
        pose.drift = mix(from.drift, pose.drift, self.warpWeight);
    }
    FinPoint point = finTables[0].points[i];
    if (point.part == kBodyPart) return pose.place;
    vec3 offset = finOffset(finTables[0].style, point, finDriveOf(self), pose.drift);
    return pose.place + turnedBy(pose.heading, offset);
}
#endif
