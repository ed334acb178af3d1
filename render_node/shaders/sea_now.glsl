// The waves and the swell at this instant; phases are reduced on the CPU in double precision.
// Layout of SeaNow in render_node/water/waves.h, std140. Lengths in metres, phases in radians.
#ifndef SEA_NOW_GLSL
#define SEA_NOW_GLSL
#include "shader_interface.h"
#include "light_plain.glsl"
layout(std140, binding = kSeaBlock) uniform SeaNow {
    vec4 waves[32];     // k.x, k.z, amplitude, phase
    vec4 ripples[32];   // the same, much shorter
    vec4 longWaves[4];  // the same, longer than the tile
    vec4 swellPhases;   // of the long and the short swell, and of two flutters, rad
    vec4 causticAxis;    // see waves.h
    vec4 surfaceDetail;
    vec4 fishWindow;
};

// How far the swell has carried the water at a place, metres: deep-water waves of 7 and 4.3 s,
// whose orbits shrink with depth, and a flutter.
vec2 surge(vec3 place) {
    const vec2 longWay = vec2(0.90, 0.44), shortWay = vec2(0.50, 0.86);
    float depth = max(-place.y, 0.0);
    float a = exp(-0.082 * depth) * cos(0.082 * dot(place.xz, longWay) - swellPhases.x);
    float b = 0.45 * exp(-0.217 * depth) * cos(0.217 * dot(place.xz, shortWay) - swellPhases.y);
    vec2 flutter = sin(swellPhases.zw + place.xz * vec2(1.1, 0.9) + place.y * vec2(1.2, 1.4));
    return longWay * a + shortWay * b + 0.10 * flutter;
}
#endif
