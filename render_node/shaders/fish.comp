// One workgroup a fish: its control points from the recorded ones (eq. 13), kept in shared memory,
// then each vertex of its surface by the stencils of its level.
#include "fish_data.glsl"

const uint kThreads = 128u;
const uint kControlPoints = 426u;
const uint kPhases = 64u;

layout(local_size_x = 128) in;
// 3 x 16 bits a point, body lengths.
layout(std430, binding = 1) readonly buffer Recorded { uvec2 recorded[]; };
layout(std430, binding = 2) readonly buffer FirstEntries { uint firstEntry[]; };
struct Entry {
    uint controlPoint;
    float position, tangentU, tangentV;
};
layout(std430, binding = 3) readonly buffer Entries { Entry entries[]; };
layout(std430, binding = 4) writeonly buffer Surface { uvec4 surface[]; };

layout(location = 0) uniform uint firstFish;    // of this batch, in the school
layout(location = 1) uniform uint firstVertex;  // of this batch, in the surface
layout(location = 2) uniform uint vertexCount;  // of one fish

shared vec3 controlPoints[kControlPoints];

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

void main() {
    Fish self = fish[firstFish + gl_WorkGroupID.x];
    for (uint i = gl_LocalInvocationID.x; i < kControlPoints; i += kThreads) {
        vec3 point = pointAt(self.segment, self.phase, i);
        if (self.warpWeight < 1.0)
            point = mix(pointAt(self.fromSegment, self.fromPhase, i), point, self.warpWeight);
        controlPoints[i] = point;
    }
    barrier();

    uint first = firstVertex + gl_WorkGroupID.x * vertexCount;
    for (uint vertex = gl_LocalInvocationID.x; vertex < vertexCount; vertex += kThreads) {
        vec3 position = vec3(0.0), tangentU = vec3(0.0), tangentV = vec3(0.0);
        uint end = firstEntry[vertex + 1u];
        for (uint k = firstEntry[vertex]; k < end; ++k) {
            Entry entry = entries[k];
            vec3 point = controlPoints[entry.controlPoint];
            position += entry.position * point;
            tangentU += entry.tangentU * point;
            tangentV += entry.tangentV * point;
        }
        vec3 world = self.positionMetres + rotate(self.rotation, position * self.lengthMetres);
        vec3 normal = rotate(self.rotation, normalize(cross(tangentU, tangentV)));
        surface[first + vertex] = uvec4(floatBitsToUint(world), packNormal(normal));
    }
}
