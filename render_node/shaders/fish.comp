// One workgroup a fish: its control points from the recorded ones (eq. 13), kept in shared memory,
// then each vertex of its surface by the stencils of its level. A fish that has just come near
// enough for a level moves its vertices from where the coarser level has them.
// In: drawn fish, recorded poses, stencils, parents, plan. Out: a page of surfaces; for each vertex
// world metres (3 floats) and a packed normal. Each thread makes every 128th vertex.
#include "shader_interface.h"
#include "fish_pose.glsl"
#include "fish_detail.glsl"
#include "fish_plan.glsl"

const uint kThreads = 128u;

layout(local_size_x = 128) in;
layout(std430, binding = kFirstEntriesStorage) readonly buffer FirstEntries { uint firstEntry[]; };
struct Entry {
    uint controlPoint;
    float position, tangentU, tangentV;
};
layout(std430, binding = kEntriesStorage) readonly buffer Entries { Entry entries[]; };
layout(std430, binding = kSurfaceStorage) coherent buffer Surface { uvec4 surface[]; };
// For each vertex the two vertices of the same mesh between which the coarser level has it: 16 bits
// each. For the control mesh its place on few triangles: three control points of 9 bits, the weights of
// two, and a normal.
layout(std430, binding = kParentsStorage) readonly buffer Parents { uint parents[]; };

layout(location = kPageLocation) uniform uint page;

shared vec3 controlPoints[kControlPoints];

struct Vertex {
    vec3 position, normal;  // body frame, body lengths
};

// Position and tangents of the limit surface are weighted sums of control points; their cross
// product is the normal.
Vertex evaluate(Mesh mesh, uint vertex) {
    vec3 position = vec3(0.0), tangentU = vec3(0.0), tangentV = vec3(0.0);
    uint end = firstEntry[mesh.firstEntry + vertex + 1u];
    for (uint k = firstEntry[mesh.firstEntry + vertex]; k < end; ++k) {
        Entry entry = entries[k];
        vec3 point = controlPoints[entry.controlPoint];
        position += entry.position * point;
        tangentU += entry.tangentU * point;
        tangentV += entry.tangentV * point;
    }
    return Vertex(position, normalize(cross(tangentU, tangentV)));
}
uvec4 packVertex(Fish self, Vertex vertex) {
    vec3 world = self.positionMetres + rotate(self.rotation, vertex.position * self.lengthMetres);
    return uvec4(floatBitsToUint(world), packNormal(rotate(self.rotation, vertex.normal)));
}

Vertex morphFromFew(Fish self, Vertex v, uint at) {
    uvec3 point = uvec3(parents[at], parents[at] >> 9, parents[at] >> 18) & 511u;
    vec2 weights = unpackUnorm2x16(parents[at + 1u]);
    vec3 onFew = weights.x * controlPoints[point.x] + weights.y * controlPoints[point.y] +
                 (1.0 - weights.x - weights.y) * controlPoints[point.z];
    v.position = mix(onFew, v.position, self.blend);
    v.normal = normalize(mix(unpackNormal(parents[at + 2u]), v.normal, self.blend));
    return v;
}

// Towards the middle of the edge or quad of the coarser level on which the vertex appears.
void morph(Fish self, bool ontoControlMesh, uint first, uint vertex, uvec2 parent) {
    uvec4 own = surface[first + vertex], a = surface[first + parent.x], b = surface[first + parent.y];
    vec3 middle = 0.5 * (uintBitsToFloat(a.xyz) + uintBitsToFloat(b.xyz));
    if (ontoControlMesh) {
        vec3 point = 0.5 * (controlPoints[parent.x] + controlPoints[parent.y]);
        middle = self.positionMetres + rotate(self.rotation, point * self.lengthMetres);
    }
    vec3 position = mix(middle, uintBitsToFloat(own.xyz), self.blend);
    vec3 normal = mix(unpackNormal(a.w) + unpackNormal(b.w), 2.0 * unpackNormal(own.w), self.blend);
    surface[first + vertex] = uvec4(floatBitsToUint(position), packNormal(normalize(normal)));
}

void main() {
    uint thread = gl_LocalInvocationID.x;
    Fish self = fish[pages[firstFishOf(page)] + gl_WorkGroupID.x];
    Living living = livingOf(self);
    for (uint i = thread; i < kControlPoints; i += kThreads)
        controlPoints[i] = controlPointOf(self, living, i);
    barrier();

    Mesh mesh = kinds[self.species].meshes[detailOf(self) - kControlMesh + 1u];
    uint first = self.firstVertex + mesh.firstVertex;
    bool ontoControlMesh = detailOf(self) == kControlMesh + 1u;
    for (uint vertex = thread; vertex < mesh.vertexCount; vertex += kThreads) {
        Vertex v = evaluate(mesh, vertex);
        if (detailOf(self) == kControlMesh && self.blend < 1.0)
            v = morphFromFew(self, v, mesh.firstParent + 3u * vertex);
        // The first vertices are the control points'.
        if (ontoControlMesh && vertex < kControlPoints)
            v.position = mix(controlPoints[vertex], v.position, self.blend);
        surface[first + vertex] = packVertex(self, v);
    }
    if (self.blend >= 1.0 || detailOf(self) == kControlMesh) return;

    memoryBarrierBuffer();
    barrier();
    for (uint vertex = thread; vertex < mesh.vertexCount; vertex += kThreads) {
        uint both = parents[mesh.firstParent + vertex];
        uvec2 parent = uvec2(both & 65535u, both >> 16);
        if (parent.x != parent.y) morph(self, ontoControlMesh, first, vertex, parent);
    }
}
