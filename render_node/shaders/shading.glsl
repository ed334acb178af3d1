// The light that falls on things, and the part of it that reaches the shared eye, for any stage. Places
// in world metres, unit normals; radiances in linear Rec. 709, relative to an irradiance of 1 at the
// surface.
#ifndef SHADING_GLSL
#define SHADING_GLSL
#include "water.glsl"

// The submarine's own floodlights, either side of the eye, bring back the reds that the sea has taken
// from the sun. They fall off with the square of the distance and by the water on their way. Their
// beams cross a few metres ahead, so that what swims at the glass is not burnt white: metres within
// which they pass by; attenuation of the three primaries, 1/m, in nature
// and where all colour is given back.
const float kLampCrossing = 2.45;
const vec3 kLampAttenuation = vec3(0.28, 0.075, 0.045), kGradedLampAttenuation = vec3(0.095);
vec3 lampLight(vec3 place, vec3 normal) {
    vec3 way = lamp.xyz - place;
    float range2 = dot(way, way), range = sqrt(range2);
    float facing = 0.15 + 0.85 * max(dot(normal, way) / range, 0.0);
    float crossed = range2 / (range2 + kLampCrossing * kLampCrossing);
    return vec3(1.0, 0.93, 0.82) * exp(-mix(kLampAttenuation, kGradedLampAttenuation, grading.x) * range) *
           (lamp.w * facing * crossed * crossed / (range2 + 1.0));
}

// Outgoing radiance of a matte surface, before the way down, which `seen` adds: sun through the
// waves, soft light from above, light from the sand; and, through thin things, light from behind.
// lod: of the caustics, by how much of the sand a pixel covers.
vec3 litAt(float lod, Occlusion open, vec3 albedo, vec3 place, vec3 normal, float translucency) {
    float depth = max(-place.y, 0.1);
    float share = unscatteredShare(depth);
    float towardsSun = dot(normal, sunAndFilterDepth.xyz);
    vec3 sun = causticColour(place, lod) * (share * open.sun) * sunlight.rgb;
    vec3 sky = (1.0 - share) * open.sky * skylight.rgb;
    vec3 sand = 0.6 * open.sky * (0.5 * (sunlight.rgb + skylight.rgb));
    float up = 0.5 + 0.5 * normal.y;
    vec3 front = sun * max(towardsSun, 0.0) + sky * mix(0.16, 1.0, up * sqrt(up));
    vec3 bounce = 0.24 * (1.0 - up) * (sky + sand);
    vec3 back = translucency * (sun * max(-towardsSun, 0.0) + 0.35 * sky);
    // The lamp's light has not come down from the surface, so the absorption that `seen` applies for
    // that is undone. 2.5 m of the diver's filter remain; with all of it the nearest reds would be too
    // bright.
    vec3 lamplit = lampLight(place, normal) *
                   exp(kdAndExposure.xyz * (depth - sunAndFilterDepth.w + 2.5));
    return albedo * (front + bounce + back + lamplit) / kPi;
}

// Many corals fluoresce: they turn the remaining blue light into their own colour.
vec3 fluorescent(vec3 albedo, float amount) { return albedo * (0.10 * amount); }

// The light that a mirror reflects: of the open water, the bright window above, the sun. Water has
// coloured this light already, so the way down that `seen` will add is taken out beforehand.
vec3 mirrored(vec3 direction, vec3 worldPosition) {
    float depth = max(-worldPosition.y, 0.1);
    float towardsSun = dot(direction, sunAndFilterDepth.xyz) - 1.0;
    vec3 water = openWater(direction, depth);
    vec3 window = 0.11 * smoothstep(0.55, 0.85, direction.y) * skylight.rgb;
    vec3 sun = (6.0 * exp(90.0 * towardsSun) + 0.9 * exp(22.0 * towardsSun)) * sunlight.rgb;
    vec3 fromSurface = window + sun * unscatteredShare(depth) * caustic(worldPosition, 1.0);
    vec3 undone = exp(kdAndExposure.xyz * (depth - sunAndFilterDepth.w));
    return ungraded(water, distance(worldPosition, eyeAndTime.xyz), depth) * undone + fromSurface;
}

// The light that reaches the shared eye: absorbed on the way, plus the light that is scattered into it.
vec3 seen(vec3 radiance, vec3 worldPosition) {
    vec3 way = worldPosition - eyeAndTime.xyz;
    float range = length(way);
    return direct(radiance, range, max(-worldPosition.y, 0.05)) + inscatter(way / range, range);
}
#endif
