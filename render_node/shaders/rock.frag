#include "shading.glsl"
layout(binding = 14) uniform sampler2D detail;  // slopes, albedo, crest
layout(location = 0) in vec3 place;
layout(location = 1) in vec4 normal;
layout(location = 2) in vec4 albedo;
layout(location = 3) in vec2 translucencyAndGlow;
layout(location = 0) out vec4 radiance;
const float kTile = 1.1;
const float kTexelsARadian = 256.0 / kTile;  // at 1 m
void main() {
    vec3 n = normalize(normal.xyz);
    float rough = normal.w;
    // Laid on from above or from the side, as the rock faces. The level of blur follows the range,
    // as across the change of sides there are no derivatives.
    float range = distance(place, eyeAndTime.xyz);
    bool above = abs(n.y) > 0.62, across = abs(n.x) > abs(n.z);
    vec2 uv = (above ? place.xz : across ? place.zy : place.xy) / kTile;
    float lod = log2(max(range * kTexelsARadian / pixelsARadian(), 1.0));
    vec4 relief = textureLod(detail, uv, lod) - vec4(0.5, 0.5, 0.0, 0.0);
    vec3 slope = above    ? vec3(relief.x, 0.0, relief.y)
                 : across ? vec3(0.0, relief.y, relief.x)
                          : vec3(relief.xy, 0.0);
    n = normalize(n - 2.8 * rough * (slope - n * dot(slope, n)));
    float crest = mix(1.0, 0.12 + 1.2 * relief.w, rough);
    // Crusts of other colours on the knobs, turf in the pits.
    vec3 hue = mix(vec3(0.75, 1.05, 0.70), vec3(1.35, 0.92, 1.05), smoothstep(0.35, 0.6, relief.z));
    vec3 colour = albedo.rgb * mix(vec3(1.0), 2.0 * relief.z * hue, rough);
    Openness open = openAt(place, normalize(normal.xyz));
    open.sun *= mix(0.5, 1.0, albedo.w);
    open.sky *= albedo.w * crest;
    vec3 light = litAt(0.3 + 0.5 * lod, open, colour, place, n, translucencyAndGlow.x);
    light += fluorescent(colour, translucencyAndGlow.y * albedo.w);
    radiance = vec4(seen(light, place), 1.0);
}
