// The sky above the sea, linear Rec. 709; relative to an irradiance of 1 at the surface.
// Directions are unit vectors in the world, above the surface.
#ifndef SKY_GLSL
#define SKY_GLSL
#include "shader_interface.h"
#include "frame_uniforms.h"
#include "sea_now.glsl"

layout(binding = kCloudTileUnit) uniform sampler2D cloudTile;  // cover of fair-weather clouds

const float kIndex = 1.34;

vec3 sunInAir() {
    vec2 across = sunAndFilterDepth.xz * kIndex;
    return vec3(across.x, sqrt(max(1.0 - dot(across, across), 0.05)), across.y);
}

// A lobe of this sharpness and height, seen through facets whose slopes spread its rays: wider and
// as much lower.
float spreadLobe(float away, float sharpness, float height, float spread) {
    float wide = sharpness / (1.0 + sharpness * spread);
    return height * (wide / sharpness) * exp(wide * away);
}

// spread: variance of the direction, rad2, that the facets in a pixel cause.
vec3 sky(vec3 direction, float spread) {
    float rise = max(direction.y, 0.04);
    vec3 blue = mix(vec3(0.046, 0.060, 0.078), vec3(0.014, 0.027, 0.054), smoothstep(0.0, 0.8, rise));
    if (kFine) {
        // A layer of clouds that drifts, denser towards the horizon.
        vec2 layer = direction.xz / (rise + 0.12);
        float lod = 2.0 + log2(1.0 + 40.0 * spread / (rise * rise));
        float cover = textureLod(cloudTile, 0.11 * layer + (6.0 / 9000.0) * eyeAndTime.w, lod).r;
        blue = mix(blue, vec3(0.085, 0.090, 0.095), smoothstep(0.42, 0.80, cover));
    }
    float away = dot(direction, sunInAir()) - 1.0;
    float sun = spreadLobe(away, 2600.0, 70.0, spread) + spreadLobe(away, 260.0, 1.2, spread) +
                0.045 * exp(14.0 * away);
    return blue * skylight.rgb + sunlight.rgb * vec3(1.0, 0.93, 0.82) * sun;
}
#endif
