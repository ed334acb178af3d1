#include "light.glsl"
layout(binding = 14) uniform sampler2D detail;  // slopes, albedo, crest
layout(location = 0) in vec3 place;
layout(location = 1) in vec4 normal;
layout(location = 2) in vec4 albedo;
layout(location = 3) in vec3 sunTranslucencyGlow;
layout(location = 0) out vec4 radiance;
const float kTile = 1.1;
void main() {
    vec3 n = normalize(normal.xyz);
    float rough = normal.w;
    // From above and from the side, as the rock faces.
    float above = smoothstep(0.3, 0.8, abs(n.y));
    vec4 top = texture(detail, place.xz / kTile) - vec4(0.5, 0.5, 0.0, 0.0);
    vec4 side = texture(detail, vec2(place.x + place.z, place.y) / kTile) -
                vec4(0.5, 0.5, 0.0, 0.0);
    vec4 relief = mix(side, top, above);
    vec3 slope = mix(vec3(0.7 * side.x, side.y, 0.7 * side.x), vec3(top.x, 0.0, top.y), above);
    n = normalize(n - 1.8 * rough * (slope - n * dot(slope, n)));
    float crest = mix(1.0, 0.35 + 0.9 * relief.w, rough);
    vec3 colour = albedo.rgb * mix(1.0, 2.0 * relief.z, rough);
    Openness open = Openness(sunTranslucencyGlow.x * mix(0.5, 1.0, albedo.w), albedo.w * crest);
    vec3 light = litUnder(open, colour, place, n, sunTranslucencyGlow.y);
    light += fluorescent(colour, sunTranslucencyGlow.z * albedo.w);
    radiance = vec4(seen(light, place), 1.0);
}
