// The effect of water on light. All radiances are relative to an irradiance of 1 at the sea's surface,
// linear Rec. 709, and may be negative in red (deep water lies outside the gamut) until the tone. Two
// coefficients, never one: Kd for the way down, kappa = a + 0.51 b for the way to the eye. Ranges and
// depths in metres; directions are unit vectors from the eye, world frame.
#ifndef WATER_GLSL
#define WATER_GLSL
#include "shader_interface.h"
#include "frame_uniforms.h"
#include "sunlight.glsl"

// Over range, depth: three columns of a matrix, and what undoes the grade.
layout(binding = kDirectTableUnit) uniform sampler2DArray directTable;
layout(binding = kInscatterTableUnit) uniform sampler3D inscatterTable;    // of the eye's depth: range, rise, azimuth
layout(binding = kOpenWaterTableUnit) uniform sampler2D openWaterTable;   // 60 m of water: over depth, rise

// The axes of the tables, as water_tables.h has them.
const vec2 kDirectTexels = vec2(64.0, 64.0);
const vec3 kInscatterTexels = vec3(kSightRanges, kSightRises, kSightAzimuths);
const vec2 kOpenWaterTexels = vec2(64.0, 32.0);
vec2 atTexelCentres(vec2 u, vec2 texels) { return (u * (texels - 1.0) + 0.5) / texels; }
// Texture coordinate of a range: the tables are finer near the eye.
float rangeAxis(float range) { return sqrt(clamp(range * (1.0 / 80.0), 0.0, 1.0)); }
// The diver's filter undoes so many metres of the way down, so the lookup uses a smaller depth.
float depthAxis(float depth) {
    return sqrt(clamp((depth - sunAndFilterDepth.w + 10.0) * (1.0 / 40.0), 0.0, 1.0));
}

// Pixels of this view in a radian, in the middle of the picture.
float pixelsARadian() { return viewport.w; }

// Henyey and Greenstein 1941.
float lobe(float cosine, float g) {
    float x = 1.0 + g * g - 2.0 * g * cosine;
    return (1.0 - g * g) / (4.0 * kPi * x * sqrt(x));
}
// The mean of what a Monte Carlo of Fournier-Forand water gives at many depths and wavelengths: light
// scattered from about the sun's ray, and from all the light that comes down. The rest, which depends
// on wavelength and depth, is in the tables (water_lobes.h).
float sunLobe(vec3 direction) { return 0.22 * lobe(dot(direction, sunAndFilterDepth.xyz), 0.64); }
float skyLobe(vec3 direction) { return 0.10 * lobe(direction.y, 0.40); }

// The share of light from a thing at this depth that reaches the eye unscattered, as a matrix: red
// things lose other wavelengths than white ones.
vec3 direct(vec3 radiance, float range, float depth) {
    vec2 uv = atTexelCentres(vec2(rangeAxis(range), depthAxis(depth)), kDirectTexels);
    return texture(directTable, vec3(uv, 0.0)).rgb * radiance.r +
           texture(directTable, vec3(uv, 1.0)).rgb * radiance.g +
           texture(directTable, vec3(uv, 2.0)).rgb * radiance.b;
}

// Light that water has coloured already, as mirrors show it, is not graded, like the sea behind the
// mirror: what the grade will add in `direct` is taken out beforehand.
vec3 ungraded(vec3 light, float range, float depth) {
    vec2 uv = atTexelCentres(vec2(rangeAxis(range), depthAxis(depth)), kDirectTexels);
    return light * texture(directTable, vec3(uv, 3.0)).rgb;
}

// Light scattered into the way from the eye over this range.
vec3 inscatter(vec3 direction, float range) {
    vec2 sun = sunAndFilterDepth.xz;
    float azimuth = dot(direction.xz, sun) *
                    inversesqrt(max(dot(direction.xz, direction.xz) * dot(sun, sun), 1.0e-8));
    vec3 at = vec3(rangeAxis(range), 0.5 + 0.5 * direction.y, 0.5 + 0.5 * azimuth);
    at = (at * (kInscatterTexels - 1.0) + 0.5) / kInscatterTexels;
    return texture(inscatterTable, at).rgb *
           (sunLobe(direction) * shaft(direction, range) * sunlight.rgb +
            skyLobe(direction) * skylight.rgb);
}

// The light of open water, seen from a place at this depth with nothing in the way.
vec3 openWater(vec3 direction, float depth) {
    vec2 uv = atTexelCentres(vec2(depthAxis(depth), 0.5 + 0.5 * direction.y), kOpenWaterTexels);
    return texture(openWaterTable, uv).rgb *
           (sunLobe(direction) * sunlight.rgb + skyLobe(direction) * skylight.rgb);
}
#endif
