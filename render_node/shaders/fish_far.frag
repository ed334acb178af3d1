// The skin of a distant fish: its colours and its flash, none of its details.
#include "light.glsl"
#include "fish_skin.glsl"

layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 rest;
layout(location = 5) flat in uint id;
layout(location = 6) flat in vec3 dorsal;
layout(location = 0) out vec4 colour;

void main() {
    float s = rest.x, v = rest.w;
    float pixel = max(length(dFdx(rest.xyz)), length(dFdy(rest.xyz)));
    float golden = goldenLine(s, v, fwidth(v));
    float eye = line(distance(rest.xy, kEye), 0.7 * kEyeRadius, pixel) ;
    vec3 albedo = groundColour(v, 0.0, golden, id) * tintOf(id) * (1.0 - 0.8 * eye);
    float silver = silverOf(s, v, golden) * (1.0 - eye);

    vec3 fromEye = normalize(place - eyeAndTime.xyz);
    vec3 n = normalize(normal);
    vec3 mirror = silverRadiance(plateletNormal(n, dorsal, -fromEye), fromEye, albedo, place);
    vec3 radiance = mix(lit(albedo, place, n, 0.0), mirror, silver);
    colour = vec4(seen(radiance, place), 1.0);
}
