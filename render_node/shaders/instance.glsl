// One of the things that stand in the place: a prototype, moved, turned, scaled and tinted.
#ifndef INSTANCE_GLSL
#define INSTANCE_GLSL
#include "frame_uniforms.h"
struct Instance {
    vec4 placeAndScale;  // world metres
    vec4 turn;           // quaternion
    vec4 tintAndSway;    // w: share of the swell that its top follows
    vec4 light;          // openness to sun and sky, height of the sand, the prototype
};
layout(std430, binding = 8) readonly buffer Instances { Instance instances[]; };

vec3 turned(vec4 turn, vec3 v) {
    return v + 2.0 * cross(turn.xyz, cross(turn.xyz, v) + turn.w * v);
}
// How many of the wall's finest pixels a thing's scale fills at the shared eye.
float pixelsOf(vec4 placeAndScale) {
    float range = max(distance(placeAndScale.xyz, sharedEyeAndPixel.xyz), 0.3);
    return placeAndScale.w / (range * sharedEyeAndPixel.w);
}
#endif
