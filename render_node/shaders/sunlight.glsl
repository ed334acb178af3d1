// Where the sun's light is more or less than its mean: gathered by the waves on things, and in shafts
// in the water.
#ifndef SUNLIGHT_GLSL
#define SUNLIGHT_GLSL
#include "frame_uniforms.h"

layout(binding = 11) uniform sampler2D causticTile;  // sunlight on the sand, mean 1
layout(binding = 12) uniform sampler2D shaftMap;  // by direction: sunlight in the water before 3, 8, 18, 45 m

const float kPi = 3.14159265;
const float kTileMetres = 12.0;  // side of the caustic tile; waves have whole numbers on it

// Octahedral map of the directions, the zenith in its middle; one texel of border continues it.
const float kShaftTexels = 128.0;
vec2 shaftPlace(vec3 direction) {
    vec2 p = direction.xz / (abs(direction.x) + abs(direction.y) + abs(direction.z));
    if (direction.y < 0.0)
        p = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
    return 0.5 + 0.5 * p * ((kShaftTexels - 2.0) / kShaftTexels);
}

// More or less than the mean that the sun lights the water along a ray: mean 1, so that light is
// neither made nor lost.
float shaft(vec3 direction, float range) {
    vec4 upTo = texture(shaftMap, shaftPlace(direction));
    vec3 share = clamp((vec3(range) - vec3(3.0, 8.0, 18.0)) / vec3(5.0, 10.0, 27.0), 0.0, 1.0);
    float near = mix(1.0, upTo.x, min(range * (1.0 / 3.0), 1.0));
    return mix(mix(mix(near, upTo.y, share.x), upTo.z, share.y), upTo.w, share.z);
}

// How the waves gather the sunlight at a place, mean 1. The tile is indexed by where the straight
// ray of the sun met the surface. Above the sand the net is not yet in focus.
float caustic(vec3 place, float lod) {
    vec3 sun = sunAndFilterDepth.xyz;
    float depth = max(-place.y, 0.0);
    vec2 uv = (place.xz + sun.xz / sun.y * depth) / kTileMetres;
    float focus = smoothstep(0.0, 7.0, depth);
    float blur = lod + 2.0 * (1.0 - focus);
    return max(mix(1.0, textureLod(causticTile, uv, blur).r, focus), 0.0);
}

float unscatteredShare(float depth) { return 0.80 * exp(-0.030 * depth); }
#endif
