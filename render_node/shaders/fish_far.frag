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
    vec3 albedo = groundColour(v, 0.0, golden, id) * tintOf(id);
    float silver = silverOf(s, v, golden);

    // Of the head's details, the two that still show: the big eye, and the gill cover's edge.
    float d = distance(rest.xy, kEye) / kEyeRadius, soft = 0.7 * pixel / kEyeRadius;
    float eye = 1.0 - smoothstep(1.0 - soft, 1.0 + soft, d);
    float pupil = 1.0 - smoothstep(0.47 - soft, 0.47 + soft, d);
    float gill = line(s - 0.245 + 0.024 * v * v, 0.004, pixel) * falling(0.60, 0.86, abs(v));
    albedo = mix(albedo, kIris * 0.85, eye);
    albedo *= (1.0 - 0.95 * pupil) * (1.0 - 0.6 * gill);
    silver *= (1.0 - eye) * (1.0 - 0.6 * gill);

    vec3 fromEye = normalize(place - eyeAndTime.xyz);
    vec3 n = normalize(normal);
    vec3 plate = plateletNormal(n, dorsal, -fromEye);
    float facing = clamp(-dot(n, fromEye), 0.0, 1.0);
    silver *= smoothstep(0.0, 0.25, facing);
    FishLight light = fishLight(place, fromEye);
    vec3 shown = reflected(normalize(mix(n, plate, silver)), fromEye, place);
    vec3 mirror = (shown + light.white * flash(plate, fromEye)) * silverTint(facing, albedo);
    vec3 matte = lit(albedo, place, n, 0.0) * light.eased;
    vec3 radiance = mix(matte, mirror, silver) + sheenOf(shown, 0.75, facing, n.y, pixel);
    colour = vec4(seen(radiance, place), 1.0);
}
