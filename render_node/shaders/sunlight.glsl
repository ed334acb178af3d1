// The sun's light relative to its mean: focused by the waves on things, and in shafts in the water.
// Depths and places in metres; a lod is log2 of a width in texels.
#ifndef SUNLIGHT_GLSL
#define SUNLIGHT_GLSL
#include "shader_interface.h"
#include "frame_uniforms.h"
#include "sea_now.glsl"
#include "shadow.glsl"

layout(binding = kCausticLayersUnit) uniform sampler2DArray causticLayers;  // sunlight at some depths, mean 1
// by direction: sunlight in the water before 3, 8, 18, 45 m
layout(binding = kShaftMapUnit) uniform sampler2D shaftMap;

const float kPi = 3.14159265;

// Octahedral map of the directions, the zenith in its middle; one texel of border continues it.
vec2 shaftPlace(vec3 direction) {
    float texels = float(textureSize(shaftMap, 0).x);
    vec2 p = direction.xz / (abs(direction.x) + abs(direction.y) + abs(direction.z));
    if (direction.y < 0.0)
        p = (1.0 - abs(p.yx)) * vec2(p.x < 0.0 ? -1.0 : 1.0, p.y < 0.0 ? -1.0 : 1.0);
    return 0.5 + 0.5 * p * ((texels - 2.0) / texels);
}

// How much the sun lights the water along a ray, relative to the mean; the mean is 1, so that light is
// conserved, without the light that rock and fish block.
float shaft(vec3 direction, float range) {
    vec4 upTo = texture(shaftMap, shaftPlace(direction));
    vec3 share = clamp((vec3(range) - vec3(3.0, 8.0, 18.0)) / vec3(5.0, 10.0, 27.0), 0.0, 1.0);
    float near = mix(1.0, upTo.x, min(range * (1.0 / 3.0), 1.0));
    return mix(mix(mix(near, upTo.y, share.x), upTo.z, share.y), upTo.w, share.z);
}

// How the waves focus the sunlight where the straight ray of the sun met the surface here, mean 1. lod:
// of texels of 47 mm. Layers by the logarithm of depth; above the first the net is not yet in focus,
// below the last it is spread.
float net(vec2 surfaceMetres, float depth, float lod) {
    float layer = log2(max(depth, 0.05) / causticAxis.x) * causticAxis.y;
    float last = causticAxis.z;
    float fine = max(lod + causticAxis.w, 0.0) + max(layer - last, 0.0);
    if (!kFine) fine = round(fine);
    float below = clamp(floor(layer), 0.0, last);
    vec2 uv = surfaceMetres / kTileMetres;
    float light = textureLod(causticLayers, vec3(uv, below), fine).r;
    if (last > 0.0) {
        float next = textureLod(causticLayers, vec3(uv, min(below + 1.0, last)), fine).r;
        light = mix(light, next, clamp(layer - below, 0.0, 1.0));
    }
    float strength = min(depth / causticAxis.x, 1.0);
    // Groups of higher and lower waves, wider than the tile: no two stretches of sand are alike.
    if (kFine)
        strength *= 0.94 + 0.16 * sin(dot(surfaceMetres, vec2(0.31, 0.17)) + swellPhases.x) +
                    0.12 * sin(dot(surfaceMetres, vec2(-0.13, 0.27)) - swellPhases.y);
    return max(1.0 + strength * (light - 1.0), 0.0);
}

float caustic(vec3 place, float lod) { return net(surfacePoint(place), max(-place.y, 0.0), lod); }

// Water bends blue light more than red. This is the shift of the mean ray of each colour (indices
// 1.331, 1.335, 1.341), reduced, as the full effect looks exaggerated.
vec3 causticColour(vec3 place, float lod) {
    vec2 at = surfacePoint(place);
    float depth = max(-place.y, 0.0);
    float green = net(at, depth, lod);
    if (!kFine) return vec3(green);
    vec3 sun = sunAndFilterDepth.xyz;
    vec2 moved = sun.xz / (sun.y * sun.y * sun.y) * (depth * surfaceDetail.y / 1.335);
    return vec3(net(at + 0.004 * moved, depth, lod), green, net(at - 0.006 * moved, depth, lod));
}

// The share of the light at a depth that comes straight from the sun.
float unscatteredShare(float depth) { return 0.80 * exp(-0.030 * depth); }
#endif
