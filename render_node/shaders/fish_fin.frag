// The fins: clear membranes between rays, growing out of the skin. Drawn from far to near and
// blended.
#include "light.glsl"
#include "fish_skin.glsl"

layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 rest;
layout(location = 3) in vec2 fin;
layout(location = 4) flat in uint part;
layout(location = 5) flat in uint id;
layout(location = 6) flat in vec3 dorsal;
layout(location = 0) out vec4 colour;

// CagePart of common/body/fish_body.h
const uint kCaudal = 1u, kFirstDorsal = 2u, kSecondDorsal = 3u, kPelvic = 5u, kPectoral = 6u;
// Spines and rays, by CagePart.
const float kRays[7] = float[](0.0, 17.0, 8.0, 26.0, 25.0, 6.0, 21.0);

struct Membrane {
    vec3 albedo;
    float opacity;
};

Membrane membraneOf(float q) {
    Membrane m = Membrane(vec3(0.34, 0.36, 0.30), 0.34 + 0.2 * falling(0.0, 0.4, q));
    if (part == kCaudal) {
        vec3 dusk = vec3(0.055, 0.06, 0.06);
        m = Membrane(mix(vec3(0.34, 0.33, 0.15), dusk, 0.75 * smoothstep(0.55, 1.0, q)), 0.80);
    } else if (part == kFirstDorsal || part == kSecondDorsal) {
        m.albedo = mix(m.albedo, vec3(0.10, 0.11, 0.11), smoothstep(0.55, 1.0, q));
        m.opacity += 0.18 * smoothstep(0.5, 1.0, q);
    } else if (part == kPectoral) {
        m.albedo = vec3(0.42, 0.42, 0.30);
    }
    return m;
}

// 1 on a ray, 0 between; rays fork towards the edge. Fades where a pixel spans more than a ray.
float rayAt(float p, float q, float count) {
    float at = p * count;
    float pixel = fwidth(at);
    float single = abs(fract(at) - 0.5) * 2.0;
    float forked = max(single, abs(fract(2.0 * at) - 0.5) * 2.0);
    float ray = part == kFirstDorsal ? single : mix(single, forked, smoothstep(0.45, 0.9, q));
    return mix(smoothstep(0.55, 0.95, ray), 0.25, clamp(2.5 * pixel - 0.4, 0.0, 1.0));
}

void main() {
    float p = fin.x, q = fin.y;
    Membrane m = membraneOf(q);
    float ray = rayAt(p, q, kRays[part]);
    m.albedo *= (0.85 + 0.25 * falling(0.0, 1.0, q)) * (1.0 - 0.45 * ray);
    m.opacity = min(m.opacity + 0.25 * ray, 1.0);

    // At its root a fin is muscle under the skin; those of the paired fins reach further out.
    bool isPaired = part == kPectoral || part == kPelvic;
    float root = isPaired ? 0.14 : 0.0;
    float reach = isPaired ? 0.42 : (part == kCaudal ? 0.22 : 0.12);
    float grown = smoothstep(root, reach, q);
    float golden = goldenLine(rest.x, rest.w, fwidth(rest.w));
    vec3 skin = groundColour(rest.w, 0.0, golden, id);
    vec3 albedo = mix(skin, m.albedo, grown) * tintOf(id);
    float silver = silverOf(rest.x, rest.w, golden) * (1.0 - grown) * (isPaired ? 0.5 : 1.0);

    vec3 fromEye = normalize(place - eyeAndTime.xyz);
    // A membrane is flat: its normal is its triangle's, and the small terms keep it from vanishing.
    vec3 facet = normalize(cross(dFdx(place), dFdy(place)) + 1.0e-14 * normal);
    if (dot(facet, fromEye) > 0.0) facet = -facet;
    // Median fins stand upright, also where a far one's triangles are thinner than a pixel.
    if (!isPaired) facet -= 0.85 * dot(facet, dorsal) * dorsal;
    vec3 n = normalize(mix(normalize(normal), facet, grown) - 1.0e-3 * fromEye);
    float facing = clamp(-dot(n, fromEye), 0.0, 1.0);
    vec3 plate = plateletNormal(n, dorsal, -fromEye);
    FishLight light = fishLight(place, fromEye);
    vec3 shown = reflected(plate, fromEye, place) + light.white * flash(plate, fromEye);
    vec3 matte = lit(albedo, place, n, 0.55 * grown) * light.eased;
    vec3 radiance = mix(matte, shown * silverTint(facing, albedo), silver);
    colour = vec4(seen(radiance, place), mix(1.0, m.opacity, grown));
}
