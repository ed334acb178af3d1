// The fins: painted membranes between rays, growing out of the skin. Blended. The skin shader's file takes the place
// of the plain one where the species has a skin shader.
// In: world place, place on skin and fin. Out: scene radiance with alpha.
#include "fish_light.glsl"
#include "skin_plain.glsl"
#include "own_skin.glsl"

layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 rest;
layout(location = 3) in vec2 fin;
layout(location = 4) flat in uint part;
layout(location = 5) flat in uint id;
layout(location = 6) flat in vec3 dorsal;
layout(location = 7) in float opacity;
layout(location = 9) flat in float size;  // of the fish, metres
layout(location = 0) out vec4 colour;

// How far from a ray, -1 .. 1 across the membrane to the next one; 0 on the ray.
float acrossRays(float p, float count) { return 2.0 * (fract(p * count) - 0.5); }

// 1 on a ray, 0 between; soft rays fork towards the edge. Where a pixel spans more than a ray, the
// mean of both.
float rayAt(Fin made, float pixel) {
    float single = abs(acrossRays(fin.x, made.rays));
    float forked = max(single, abs(acrossRays(fin.x, 2.0 * made.rays)));
    float forks = smoothstep(0.40, 0.85, fin.y) * step(made.spined, fin.x);
    float ray = smoothstep(0.70, 0.97, mix(single, forked, forks));
    return mix(ray, 0.15, clamp(2.5 * pixel - 0.4, 0.0, 1.0));
}

void main() {
    float pixel = max(length(dFdx(rest.xyz)), length(dFdy(rest.xyz)));
    SkinPoint at = SkinPoint(rest.x, rest.y, rest.z, rest.w, pixel, fwidth(rest.w), id, size, 0.0, 1.0, 0.0);
    bool isPaired = part == kPectoral || part == kPelvic;
    vec3 fromEye = normalize(place - eyeAndTime.xyz);
    // A membrane is flat: its normal is its triangle's, and the small terms keep it from vanishing.
    vec3 facet = normalize(cross(dFdx(place), dFdy(place)) + 1.0e-14 * normal);
    if (dot(facet, fromEye) > 0.0) facet = -facet;
    float throughIt = max(-dot(facet, fromEye), 0.12);
    float under = smoothstep(0.05, -0.15, dot(facet, dorsal));
    // Median fins stand upright, also where a far one's triangles are thinner than a pixel.
    if (!isPaired) facet -= 0.85 * dot(facet, dorsal) * dorsal;

    Skin root = wornGround(at);
    Fin made = wornFin(FinPoint(part, fin.x, fin.y, under, at), root);
    bool isFleshy = made.rays < 1.0;
    float pixelRays = fwidth(fin.x * made.rays);
    float ray = isFleshy ? 0.0 : rayAt(made, pixelRays);
    // The edge of a membrane is thin and clear, its rays are bone.
    made.albedo *= (1.05 - 0.15 * fin.y) * (1.0 - made.ribbing * ray);
    made.opacity = clamp(made.opacity - (isFleshy ? 0.0 : 0.10 * fin.y) + 0.25 * ray, 0.0, 1.0);
    // A line of sight near its plane passes through more of the membrane.
    made.opacity = 1.0 - pow(1.0 - made.opacity, 1.0 / throughIt);
    // At its root a fin is muscle under the skin; on the paired fins it reaches further out.
    float reach = isPaired ? mix(0.55, 0.20, made.opacity) : 0.12;
    float grown = smoothstep(0.0, reach, fin.y);
    Skin skin = root;
    skin.albedo = wetAlbedo(mix(root.albedo, made.albedo, grown), id);

    vec3 n = mix(normalize(normal), facet, grown);
    // Rays stand out like ribs.
    float relief = isFleshy ? 0.0 : made.ribbing * grown * clamp(1.0 - 2.0 * pixelRays, 0.0, 1.0);
    vec3 across = normalize(dFdx(place) * dFdx(fin.x) + dFdy(place) * dFdy(fin.x) + 1.0e-12);
    n += 0.7 * relief * across * acrossRays(fin.x, made.rays) * abs(acrossRays(fin.x, made.rays));
    n = normalize(n - 1.0e-3 * fromEye);

    // Light passes through: from the sun behind a fin most of it goes straight on.
    float thin = isFleshy ? 0.0 : grown * (1.0 - 0.5 * ray);
    float ahead = max(dot(fromEye, sunAndFilterDepth.xyz), 0.0);
    float glow = 0.55 * thin * (1.0 + 1.5 * ahead * ahead * ahead * ahead);
    vec3 radiance = lit(skin.albedo, place, n, glow);
    float silver = root.silver * (1.0 - grown) * (isPaired ? 0.5 : 1.0);
    if (silver > 0.0) {
        float facing = clamp(-dot(n, fromEye), 0.0, 1.0);
        vec3 plate = plateletNormal(n, dorsal, -fromEye);
        vec3 shown = around(reflect(fromEye, plate), place);
        radiance = underSilver(radiance, silvered(shown, plate, skin.albedo, place, facing), silver);
    }
    // The body is open behind the root of a paired fin: that part is always opaque.
    float clear = isPaired ? smoothstep(0.30, 0.60, fin.y) : smoothstep(0.0, 2.0 * reach, fin.y);
    // The rim ends softly within two pixels, also where a tier has one sample a pixel.
    float rim = clamp((1.0 - fin.y) / max(2.0 * fwidth(fin.y), 1.0e-4), 0.0, 1.0);
    rim = mix(rim, 1.0, clamp(6.0 * fwidth(fin.y) - 0.5, 0.0, 1.0));
    colour = vec4(seen(radiance, place), opacity * rim * mix(1.0, made.opacity, clear));
}
