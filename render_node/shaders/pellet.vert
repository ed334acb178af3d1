// A crumb of fish food: an uneven octahedron that tumbles as it sinks, lit on each face. Those that cannot be seen are
// left out first. In: specks by instance, world metres; 24 vertices. Out: light that reaches the eye, coverage, clip
// space.
#include "shader_interface.h"
#include "food_particle.glsl"
#include "shading.glsl"
layout(location = 0) out vec3 light;
layout(location = 1) out float coverage;
const float kLeastPixels = 3.0;  // least diameter: a smaller one would fall between the pixels
// Albedo of a crumb.
const vec3 kCrumb = vec3(0.66, 0.27, 0.07);

// Directions of corners 0 to 5: right, left, up, down, towards the eye, away.
vec3 cornerOf(int corner, uint seed) {
    vec3 axis = vec3(corner >> 1 == 0, corner >> 1 == 1, corner >> 1 == 2);
    return axis * (((corner & 1) == 0 ? 1.0 : -1.0) * mix(0.6, 1.0, unit(seed, 6u + uint(corner))));
}
vec3 tumbled(vec3 v, vec3 axis, float angle) {
    return mix(axis * dot(axis, v), v, cos(angle)) + cross(axis, v) * sin(angle);
}

void main() {
    Speck speck = specks[gl_InstanceID];
    vec3 way = speck.place - eyeAndTime.xyz;
    float range = length(way);
    light = vec3(0.0);
    coverage = 0.0;
    gl_Position = kOutside;
    if (range >= kPelletMetres || !isInFrustum(speck.place, kMostReach)) return;
    float radius = mix(0.007, 0.013, unit(speck.seed, 3u));
    float pixels = 2.0 * radius / range * pixelsARadian();
    float larger = max(kLeastPixels / max(pixels, 1.0e-3), 1.0);
    vec3 axis = axisOf(speck.seed);
    float angle = eyeAndTime.w * mix(0.6, 1.8, unit(speck.seed, 4u)) + 6.2832 * unit(speck.seed, 5u);

    // Face: one octant; its three corners are one of each axis.
    int face = gl_VertexID / 3;
    vec3 corners[3];
    for (int i = 0; i < 3; ++i)
        corners[i] = tumbled(cornerOf(2 * i + (face >> i & 1), speck.seed), axis, angle);
    vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    vec3 normal = normalize(cross(corners[1] - corners[0], corners[2] - corners[0]));
    normal *= dot(normal, middle) < 0.0 ? -1.0 : 1.0;

    vec3 place = speck.place + corners[gl_VertexID % 3] * (radius * larger);
    vec3 albedo = kCrumb * mix(0.7, 1.2, unit(speck.seed, 12u));
    light = seen(litAt(1.0, Occlusion(1.0, 1.0), albedo, speck.place, normal, 0.2), speck.place);
    coverage = smoothstep(kPelletMetres, 0.7 * kPelletMetres, range) / (larger * larger);
    // The far side is hidden by the near one.
    bool hidden = dot(normal, speck.place + middle * (radius * larger) - eyeAndTime.xyz) >= 0.0;
    if (!hidden) gl_Position = clipFromWorld * vec4(place, 1.0);
}
