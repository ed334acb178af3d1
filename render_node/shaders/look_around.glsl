// Places of the picture at an angular distance from another. They are the same in the world for every
// orientation of the channel's picture, so that neighbours read the same places. uv: 0 to 1, origin
// bottom left. Angles in radians. `clip` has x, y and w of clip space.
#ifndef LOOK_AROUND_GLSL
#define LOOK_AROUND_GLSL
#include "frame_uniforms.h"

vec3 clipOf(vec3 direction) {  // x, y and w; w is the cosine from the axis
    vec4 clip = clipFromWorld * vec4(direction, 0.0);
    return clip.xyw;
}

// A pixel's direction, and a radian to its right and above it.
struct Neighbourhood {
    vec3 ahead, right, up;
};
Neighbourhood neighbourhoodOf(vec2 uv) {
    vec4 near = worldFromClip * vec4(uv * 2.0 - 1.0, 1.0, 1.0);
    vec3 ahead = normalize(near.xyz / near.w - eyeAndTime.xyz);
    vec3 right = normalize(cross(ahead, vec3(0.0, 1.0, 0.013)));
    return Neighbourhood(clipOf(ahead), clipOf(right), clipOf(cross(right, ahead)));
}
vec3 beside(Neighbourhood at, vec2 radians) {
    return at.ahead + radians.x * at.right + radians.y * at.up;
}
vec2 uvOf(vec3 clip) { return 0.5 + 0.5 * clip.xy / clip.z; }

// 1 over the range of the thing that is seen there, which is 80 m at most; depth is near / distance along the axis.
float nearnessOf(vec3 clip, float depth) {
    return max(depth * clip.z / clipFromWorld[3].z, 1.0 / 80.0);
}
#endif
