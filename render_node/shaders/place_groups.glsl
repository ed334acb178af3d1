// Balls against the view's frustum, and the balls about groups of instances.
// World metres; the matrix of the view is that of the frame's uniform block.
#ifndef PLACE_GROUPS_GLSL
#define PLACE_GROUPS_GLSL
#include "shader_interface.h"
#include "frame_uniforms.h"
layout(std430, binding = kGroupsStorage) readonly buffer Groups { vec4 groupBalls[]; };
layout(location = kCullingLocation) uniform bool culling;

// Tests the four sides only: few things are in front of the near plane or behind the far one.
bool sees(vec3 centre, float reach) {
    if (!culling) return true;
    mat4 rows = transpose(clipFromWorld);
    for (int side = 0; side < 4; ++side) {
        vec4 plane = rows[3] + ((side & 1) == 0 ? rows[side >> 1] : -rows[side >> 1]);
        if (dot(plane.xyz, centre) + plane.w < -reach * length(plane.xyz)) return false;
    }
    return true;
}
#endif
