// Balls against the frustum of the view in the frame's uniform block. World metres.
#ifndef FRUSTUM_GLSL
#define FRUSTUM_GLSL
#include "frame_uniforms.h"
// Whether a part of the ball may be in view. Tests the four sides only: few things are in front of the near plane or
// behind the far one.
bool isInFrustum(vec3 centre, float reach) {
    mat4 rows = transpose(clipFromWorld);
    for (int side = 0; side < 4; ++side) {
        vec4 plane = rows[3] + ((side & 1) == 0 ? rows[side >> 1] : -rows[side >> 1]);
        if (dot(plane.xyz, centre) + plane.w < -reach * length(plane.xyz)) return false;
    }
    return true;
}
#endif
