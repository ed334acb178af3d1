// The fins of a fish of the reef: painted membranes between rays, growing out of the skin. Drawn from
// far to near and blended.
#include "light.glsl"
#include "reef_skins.glsl"

layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 rest;
layout(location = 3) in vec2 fin;
layout(location = 4) flat in uint part;
layout(location = 5) flat in uint id;
layout(location = 6) flat in vec3 dorsal;
layout(location = 0) out vec4 colour;

const float kRays = 18.0;

float rayAt(float p) {
    float at = p * kRays;
    float pixel = fwidth(at);
    float ray = smoothstep(0.55, 0.95, abs(fract(at) - 0.5) * 2.0);
    return mix(ray, 0.25, clamp(2.5 * pixel - 0.4, 0.0, 1.0));
}

void main() {
    float p = fin.x, q = fin.y;
    float pixel = max(length(dFdx(rest.xyz)), length(dFdy(rest.xyz)));
    vec3 skin = paintOf(rest.x, rest.w, rest.y, id, pixel).albedo;
    Fin membrane = finOf(part, p, q, skin);
    bool isFleshy = pattern == kBlacktip;
    float ray = isFleshy ? 0.0 : rayAt(p);
    membrane.albedo *= 1.0 - 0.35 * ray;
    membrane.opacity = min(membrane.opacity + 0.2 * ray, 1.0);

    bool isPaired = part == kPectoral || part == kPelvic;
    float grown = smoothstep(0.0, isPaired ? 0.30 : 0.14, q);
    vec3 albedo = mix(skin, membrane.albedo, grown) * tintOf(id);

    vec3 fromEye = normalize(place - eyeAndTime.xyz);
    // A membrane is flat: its normal is its triangle's, and the small terms keep it from vanishing.
    vec3 facet = normalize(cross(dFdx(place), dFdy(place)) + 1.0e-14 * normal);
    if (dot(facet, fromEye) > 0.0) facet = -facet;
    if (!isPaired) facet -= 0.85 * dot(facet, dorsal) * dorsal;
    vec3 n = normalize(mix(normalize(normal), facet, grown) - 1.0e-3 * fromEye);
    FishLight light = fishLight(place, fromEye);
    float through = isFleshy ? 0.0 : 0.5 * grown;
    vec3 radiance = lit(albedo, place, n, through) * light.eased;
    colour = vec4(seen(radiance, place), mix(1.0, membrane.opacity, grown));
}
