// The skin of a fish (first form).
#include "light.glsl"
#include "fish_skin.glsl"

layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 rest;
layout(location = 5) flat in uint id;
layout(location = 6) flat in vec3 dorsal;
layout(location = 0) out vec4 colour;

void main() {
    float stripe;
    vec3 albedo = ground(rest.x, rest.w, id, 0.0, fwidth(rest.w), stripe) * tintOf(id);
    vec3 n = normalize(normal);
    vec3 plate = normalize(n - 0.8 * dot(n, dorsal) * dorsal);
    vec3 fromEye = normalize(place - eyeAndTime.xyz);
    vec3 mirror = mirrored(reflect(fromEye, plate), place) * (0.55 + 0.75 * albedo);
    vec3 radiance = mix(lit(albedo, place, n, 0.0), mirror, silverOf(rest.x, rest.w, stripe));
    colour = vec4(seen(radiance, place), 1.0);
}
