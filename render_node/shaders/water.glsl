// What water does to light. All radiances are relative to an irradiance of 1 at the sea's surface,
// linear Rec. 709, and may be negative in red (deep water lies outside the gamut) until the tone.
// Two coefficients, never one: Kd for the way down, kappa = a + 0.51 b for the way to the eye.
#ifndef WATER_GLSL
#define WATER_GLSL
#include "frame_uniforms.h"

layout(binding = 8) uniform sampler2DArray directTable;  // columns of a 3x3 matrix over range, depth
layout(binding = 9) uniform sampler2D inscatterTable;    // at the eye's depth: over range, rise
layout(binding = 10) uniform sampler2D openWaterTable;   // 60 m of water: over depth, rise
layout(binding = 11) uniform sampler2D causticTile;      // sunlight on the sand, mean 1
layout(binding = 12) uniform sampler2D shaftMap;  // by direction: sunlight in the water before 3, 8, 18, 45 m

const float kPi = 3.14159265;
const float kTileMetres = 12.0;  // side of the caustic tile; waves have whole numbers on it

// The axes of the tables, as water_tables.h has them.
const vec2 kDirectTexels = vec2(64.0, 32.0);
const vec2 kInscatterTexels = vec2(64.0, 32.0);
const vec2 kOpenWaterTexels = vec2(32.0, 32.0);
vec2 atTexelCentres(vec2 u, vec2 texels) { return (u * (texels - 1.0) + 0.5) / texels; }
// Of the water that lies between, this share counts: the reef is seen as from so much nearer, or
// red would be gone before the wall's nearest sand (5.6 m). 1 is the true sea.
const float kRangeShare = 0.6;
float rangeAxis(float range) { return sqrt(clamp(range * (kRangeShare / 80.0), 0.0, 1.0)); }
// The diver's filter undoes so many metres of the way down: one looks up at a lesser depth.
float depthAxis(float depth) {
    return sqrt(clamp((depth - sunAndFilterDepth.w + 10.0) * (1.0 / 40.0), 0.0, 1.0));
}

float pixelsARadian() {
    vec3 row = vec3(clipFromWorld[0].y, clipFromWorld[1].y, clipFromWorld[2].y);
    return 0.5 * viewport.y * length(row);
}

// Henyey and Greenstein 1941.
float lobe(float cosine, float g) {
    float x = 1.0 + g * g - 2.0 * g * cosine;
    return (1.0 - g * g) / (4.0 * kPi * x * sqrt(x));
}
// Fitted to a Monte Carlo of Fournier-Forand water: light scattered from the sun's ray, and from
// all the light that comes down.
float sunLobe(vec3 direction) { return 0.51 * lobe(dot(direction, sunAndFilterDepth.xyz), 0.84); }
float skyLobe(vec3 direction) { return 0.245 * lobe(direction.y, 0.70); }

// The share of light from a thing at this depth that reaches the eye unscattered, as a matrix: red
// things lose other wavelengths than white ones.
vec3 direct(vec3 radiance, float range, float depth) {
    vec2 uv = atTexelCentres(vec2(rangeAxis(range), depthAxis(depth)), kDirectTexels);
    return texture(directTable, vec3(uv, 0.0)).rgb * radiance.r +
           texture(directTable, vec3(uv, 1.0)).rgb * radiance.g +
           texture(directTable, vec3(uv, 2.0)).rgb * radiance.b;
}

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

// Light scattered into the way from the eye over this range.
vec3 inscatter(vec3 direction, float range) {
    vec2 uv = atTexelCentres(vec2(rangeAxis(range), 0.5 + 0.5 * direction.y), kInscatterTexels);
    return texture(inscatterTable, uv).rgb *
           (sunLobe(direction) * shaft(direction, range) * daylight.x +
            skyLobe(direction) * daylight.yzw);
}

// The water itself, seen from a place at this depth with nothing in the way.
vec3 openWater(vec3 direction, float depth) {
    vec2 uv = atTexelCentres(vec2(depthAxis(depth), 0.5 + 0.5 * direction.y), kOpenWaterTexels);
    return texture(openWaterTable, uv).rgb *
           (sunLobe(direction) * daylight.x + skyLobe(direction) * daylight.yzw);
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
