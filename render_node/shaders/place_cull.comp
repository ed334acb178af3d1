// What of the place a view may show, and how finely: each instance becomes one more of the draw of
// its prototype at its level. A ball against the four sides of the frustum; the level follows from
// the angle at the shared eye in units of the wall's finest pixel, so that neighbours agree.
#include "frame_uniforms.h"
#include "instance.glsl"
layout(local_size_x = 64) in;
struct Prototype {
    float reach, middle;
    uint firstCommand, commandStride;
    float leastPixels[4];
};
struct Command {
    uint count, instanceCount, firstIndex;
    int baseVertex;
    uint baseInstance;
};
layout(std430, binding = 9) readonly buffer Prototypes { Prototype prototypes[]; };
layout(std430, binding = 10) buffer Commands { Command commands[]; };
layout(std430, binding = 11) writeonly buffer Chosen { uint chosenOnes[]; };
layout(location = 0) uniform uint instanceCount;
layout(location = 1) uniform bool culling;
layout(location = 2) uniform float detail;

bool sees(vec3 centre, float reach) {
    mat4 rows = transpose(clipFromWorld);
    for (int side = 0; side < 4; ++side) {
        vec4 plane = rows[3] + ((side & 1) == 0 ? rows[side >> 1] : -rows[side >> 1]);
        if (dot(plane.xyz, centre) + plane.w < -reach * length(plane.xyz)) return false;
    }
    return true;
}

void main() {
    uint id = gl_GlobalInvocationID.x;
    if (id >= instanceCount) return;
    Instance one = instances[id];
    Prototype prototype = prototypes[uint(one.light.w)];
    float scale = one.placeAndScale.w;
    vec3 centre = one.placeAndScale.xyz + turned(one.turn, vec3(0.0, prototype.middle * scale, 0.0));
    // What bends reaches further.
    float reach = scale * (prototype.reach + 1.5 * one.tintAndSway.w);
    if (culling && !sees(centre, reach)) return;
    float pixels = detail * pixelsOf(one.placeAndScale);
    uint level = 0u;
    while (level < 4u && pixels < prototype.leastPixels[level]) ++level;
    if (level == 4u) return;
    uint command = prototype.firstCommand + level * prototype.commandStride;
    uint slot = commands[command].baseInstance + atomicAdd(commands[command].instanceCount, 1u);
    chosenOnes[slot] = id;
}
