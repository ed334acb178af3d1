// One of the things that stand in the place: a prototype, moved, turned, scaled and tinted.
// turned() rotates from the prototype's frame to the world; quaternions are x, y, z, w.
#ifndef INSTANCE_GLSL
#define INSTANCE_GLSL
#include "shader_interface.h"
#include "frame_uniforms.h"
struct Instance {
    vec4 placeAndScale;  // world metres
    vec4 turn;           // quaternion
    vec4 tintAndSway;    // w: share of the swell that its top follows
    vec2 occlusion;      // sun visibility, ambient occlusion
    float sandHeightMetres;
    uint prototype;
};
layout(std430, binding = kInstancesStorage) readonly buffer Instances { Instance instances[]; };

vec3 turned(vec4 turn, vec3 v) {
    return v + 2.0 * cross(turn.xyz, cross(turn.xyz, v) + turn.w * v);
}
// What place_cull.comp has chosen: the number of an instance, and how far its level has faded into the
// coarser one, 0 to 1.
const uint kInstanceMask = (1u << kInstanceBits) - 1u;
uint packedChoice(uint id, float faded) { return id | uint(faded * 255.0 + 0.5) << kInstanceBits; }
Instance instanceOf(uint choice) { return instances[choice & kInstanceMask]; }
float fadedOf(uint choice) { return float(choice >> kInstanceBits) / 255.0; }
// How many of the wall's finest pixels a thing's scale fills at the shared eye.
float pixelsOf(vec4 placeAndScale) {
    float range = max(distance(placeAndScale.xyz, sharedEyeAndPixel.xyz), 0.3);
    return placeAndScale.w / (range * sharedEyeAndPixel.w);
}
#endif
