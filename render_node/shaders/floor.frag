#include "light.glsl"
layout(binding = 14) uniform sampler2D detail;  // slopes, albedo, crest
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 0) out vec4 radiance;
const float kTile = 2.6;
const vec3 kSand = vec3(0.44, 0.39, 0.31);
void main() {
    vec4 fine = texture(detail, place.xz / kTile);
    // A second look, larger and turned, so that the tile is not seen to repeat.
    vec2 turned = vec2(place.x * 0.83 - place.z * 0.56, place.x * 0.56 + place.z * 0.83);
    vec4 coarse = texture(detail, turned / (kTile * 5.3));
    vec2 slope = 2.0 * (fine.xy - 0.5) + 0.5 * (coarse.xy - 0.5);
    vec3 n = normalize(normal - vec3(slope.x, 0.0, slope.y));
    Openness open = openAt(place, normal);
    vec3 albedo = kSand * (2.0 * fine.z) * (0.55 + 0.9 * coarse.z);
    open.sky *= 0.75 + 0.3 * fine.w;
    radiance = vec4(seen(litUnder(open, albedo, place, n, 0.0), place), 1.0);
}
