// One workgroup a fish: its control points from the recorded ones (eq. 13), kept in shared memory,
// then each vertex of its surface by the stencils of its level.
#include "fish_pose.glsl"

const uint kThreads = 128u;

layout(local_size_x = 128) in;
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

void main() {
    Fish self = fish[firstFish + gl_WorkGroupID.x];
    for (uint i = gl_LocalInvocationID.x; i < kControlPoints; i += kThreads) {
        controlPoints[i] = controlPointOf(self, i);
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
