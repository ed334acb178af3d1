// A fish's control points from the recorded ones (eq. 13), and its fins moved beside them; in its body
// frame, body lengths. The reference is tests/render_node/surface/living_cage.h.
// livingOf() and then controlPointOf() are the entries. Phases are in cycles; the time is the frame's.
#ifndef FISH_POSE_GLSL
#define FISH_POSE_GLSL
#include "shader_interface.h"
#include "frame_uniforms.h"
#include "fish_school.glsl"
#include "fish_fins.glsl"

const uint kPoses = kActions * kPhases * kControlPoints;
const uint kFinPoses = kActions * kPhases * 2u;               // left and right, of pectoral fins
const uint kFinNumbers = 6u * 2u + kControlPoints * 2u * 2u;  // of a FinStyle, and of FinPoints
const uint kSpeciesWords = kPoses + kFinPoses + kFinNumbers;
// Species by species. First by action and phase the points: 3 x 16 bits, body lengths, then a heading,
// half turns; then by action and phase the poses of the fins: 3 x 16 bits; then the fins. A texture, as
// a storage block of 128 MiB would hold 16 species.
layout(binding = kRecordedUnit) uniform usamplerBuffer recordedPoses;
uvec2 recordedAt(uint k) { return texelFetch(recordedPoses, int(k)).xy; }

vec4 finNumbers(uint species, uint vector) {
    uint k = species * kSpeciesWords + kPoses + kFinPoses + 2u * vector;
    return uintBitsToFloat(uvec4(recordedAt(k), recordedAt(k + 1u)));
}

FinPoint finPointOf(uint species, uint i) {
    vec4 arm = finNumbers(species, 6u + 2u * i), place = finNumbers(species, 7u + 2u * i);
    return FinPoint(arm.xyz, arm.w, place.x, place.y, place.z, floatBitsToUint(place.w));
}

FinStyle finStyleOf(uint species) {
    vec4 a = finNumbers(species, 0u), b = finNumbers(species, 1u), c = finNumbers(species, 2u);
    vec4 d = finNumbers(species, 3u), e = finNumbers(species, 4u), f = finNumbers(species, 5u);
    return FinStyle(a.xyz, a.w, b.xyz, b.w, c.xyz, c.w, d.x, d.y, d.z, d.w, e.x, e.y, e.z, e.w, f.x,
                    f.y);
}

// Radians; side 0 is left.
vec3 recordedFin(uint species, uint action, uint phase, uint side) {
    uvec2 bits = recordedAt(species * kSpeciesWords + kPoses + (action * kPhases + phase) * 2u + side);
    return vec3(unpackSnorm2x16(bits.x), unpackSnorm2x16(bits.y).x) * kMostFinAngle;
}

// A fin between two recorded phases.
vec3 finAt(uint species, uint action, float phase, uint side) {
    float sampled = phase * float(kPhases);
    uint before = uint(floor(sampled)) % kPhases;
    return mix(recordedFin(species, action, before, side),
               recordedFin(species, action, (before + 1u) % kPhases, side), fract(sampled));
}

vec3 finOf(Fish self, uint side) {
    vec3 fin = finAt(self.species, self.action, self.phase, side);
    if (self.warpWeight == 1.0) return fin;
    return mix(finAt(self.species, self.fromAction, self.fromPhase, side), fin, self.warpWeight);
}

struct Posed {
    vec3 place;
    float heading;
    float drift;  // to the right, body lengths in a radian of the beat
};

vec4 recordedPoint(uint species, uint action, uint phase, uint point) {
    uint pose = action * kPhases + phase;
    uvec2 bits = recordedAt(species * kSpeciesWords + pose * kControlPoints + point);
    return vec4(unpackSnorm2x16(bits.x), unpackSnorm2x16(bits.y));
}

// A control point between two recorded phases, and how it drifts sideways in between (eq. 13).
Posed posedAt(uint species, uint action, float phase, uint point) {
    float sampled = phase * float(kPhases);
    uint before = uint(floor(sampled)) % kPhases;
    vec4 from = recordedPoint(species, action, before, point);
    vec4 to = recordedPoint(species, action, (before + 1u) % kPhases, point);
    vec4 here = mix(from, to, fract(sampled));
    float heading = here.w * 0.5 * kWholeTurn;
    vec3 right = vec3(sin(heading), 0.0, cos(heading));
    return Posed(here.xyz, heading, dot(to.xyz - from.xyz, right) * float(kPhases) / kWholeTurn);
}

FinDrive finDriveOf(Fish self) {
    return FinDrive(mod(eyeAndTime.w, kFinSeconds), self.speed, rotate(self.rotation, vec3(0.0, 0.0, 1.0)).y,
                    self.spread, finOf(self, 0u), finOf(self, 1u), fract(0.37 * float(self.id)), self.phase,
                    self.fromPhase, self.warpWeight);
}

// What moves beside the body, alike for all control points of a fish.
struct Living {
    FinStyle style;
    FinDrive drive;
    FacePose face;
};
Living livingOf(Fish self) {
    return Living(finStyleOf(self.species), finDriveOf(self), facePose(self, eyeAndTime.w));
}

vec3 controlPointOf(Fish self, Living living, uint i) {
    Posed pose = posedAt(self.species, self.action, self.phase, i);
    if (self.warpWeight < 1.0) {
        Posed from = posedAt(self.species, self.fromAction, self.fromPhase, i);
        pose.place = mix(from.place, pose.place, self.warpWeight);
        pose.heading = mix(from.heading, pose.heading, self.warpWeight);
        pose.drift = mix(from.drift, pose.drift, self.warpWeight);
    }
    FinPoint point = finPointOf(self.species, i);
    if (point.part == kBody) {
        if (point.p + point.q + point.sway == 0.0) return pose.place;  // most are behind the head
        vec3 offset = faceOffset(living.style, point, living.face);
        return pose.place + turnedBy(pose.heading, offset);
    }
    vec3 offset = finOffset(living.style, point, living.drive, pose.drift);
    return pose.place + turnedBy(pose.heading, offset);
}
#endif
