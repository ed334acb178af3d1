// Adds each fish's momentum to the eight cells about it.
// In: records of the fish. Out: sums in the cells, integers in units of kWakeUnit; one thread for
// each fish.
#include "shader_interface.h"
#include "fish_record.glsl"
#include "wake.glsl"
layout(local_size_x = kGroupSize) in;
layout(location = kWakeFishCountLocation) uniform uint fishCount;
layout(std430, binding = kWakeStorage) buffer Wake { int wake[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= fishCount || isAway(i)) return;
    float size = lengthMetresOf(i) * 4.0;
    // A fish swims along the x axis of its mean frame.
    vec4 q = rotationOf(i);
    const vec3 kAlong = vec3(1.0, 0.0, 0.0);
    vec3 ahead = kAlong + 2.0 * cross(q.xyz, cross(q.xyz, kAlong) + q.w * kAlong);
    vec3 momentum = ahead * (speedOf(i) * lengthMetresOf(i) * min(size * size, 8.0));
    vec3 at = placeMetresOf(i) / kWakeCellMetres - 0.5;
    ivec3 low = ivec3(floor(at));
    vec3 share = at - vec3(low);
    for (int corner = 0; corner < 8; ++corner) {
        ivec3 offset = ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
        vec3 weight = mix(1.0 - share, share, vec3(offset));
        int index = wakeIndex(low + offset);
        if (index < 0) continue;
        ivec3 part = ivec3(round(momentum * (weight.x * weight.y * weight.z / kWakeUnit)));
        for (int axis = 0; axis < 3; ++axis) atomicAdd(wake[index + axis], part[axis]);
    }
}
