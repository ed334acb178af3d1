// Rock: grit, pits and knobs at up to three scales, laid on from three sides; turf on what looks
// up, pink crusts of algae in the shade, sponges in patches.
#include "light.glsl"
layout(binding = 14) uniform sampler2D detail;  // slopes, albedo, crest
layout(location = 0) uniform int scales;        // 1 to 3
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 mottle;  // lightness, turf, crust
layout(location = 3) in vec2 open;
layout(location = 4) in vec3 tint;
layout(location = 0) out vec4 radiance;
const float kTexels = 512.0;

// xyz: slope as a vector of the world; tone: albedo and crest.
struct Relief {
    vec3 slope;
    vec2 tone;
};
Relief reliefAt(vec3 p, vec3 weight, float tile, float pixelMetres) {
    float lod = log2(max(pixelMetres * kTexels / tile, 1.0));
    vec4 above = textureLod(detail, p.xz / tile, lod) - vec4(0.5, 0.5, 0.0, 0.0);
    vec4 east = textureLod(detail, p.zy / tile + 0.37, lod) - vec4(0.5, 0.5, 0.0, 0.0);
    vec4 south = textureLod(detail, p.xy / tile + 0.71, lod) - vec4(0.5, 0.5, 0.0, 0.0);
    vec3 slope = weight.y * vec3(above.x, 0.0, above.y) + weight.x * vec3(0.0, east.y, east.x) +
                 weight.z * vec3(south.xy, 0.0);
    return Relief(slope, weight.y * above.zw + weight.x * east.zw + weight.z * south.zw);
}
// One side alone, for those who must save.
Relief cheapReliefAt(vec3 p, vec3 n, float tile, float pixelMetres) {
    vec3 side = abs(n);
    vec3 weight = side.y > 0.62 ? vec3(0, 1, 0) : side.x > side.z ? vec3(1, 0, 0) : vec3(0, 0, 1);
    vec2 uv = weight.y > 0.0 ? p.xz : weight.x > 0.0 ? p.zy : p.xy;
    vec4 one = textureLod(detail, uv / tile, log2(max(pixelMetres * kTexels / tile, 1.0)));
    vec2 slope = one.xy - 0.5;
    return Relief(weight.y > 0.0 ? vec3(slope.x, 0.0, slope.y)
                                 : weight.x > 0.0 ? vec3(0.0, slope.y, slope.x) : vec3(slope, 0.0), one.zw);
}
void main() {
    vec3 n = normalize(normal);
    float pixelMetres = distance(place, eyeAndTime.xyz) / pixelsARadian();
    vec3 weight = pow(abs(n), vec3(4.0));
    weight /= weight.x + weight.y + weight.z;
    Relief broad, middle, fine = Relief(vec3(0.0), vec2(0.5));
    if (scales > 1) {
        broad = reliefAt(place, weight, 3.7, pixelMetres);
        middle = reliefAt(place + 0.9, weight, 1.1, pixelMetres);
        if (scales > 2) fine = reliefAt(place, weight, 0.31, pixelMetres);
    } else {
        middle = cheapReliefAt(place, n, 1.1, pixelMetres);
        broad = Relief(vec3(0.0), middle.tone);
    }
    vec3 slope = 1.6 * broad.slope + 2.0 * middle.slope + 1.1 * fine.slope;
    n = normalize(n - (slope - n * dot(slope, n)));
    float tone = 2.0 * middle.tone.x * mix(1.0, 2.0 * fine.tone.x, 0.6);
    float pits = mix(0.30, 1.0, smoothstep(0.15, 0.75, middle.tone.y)) * mix(0.6, 1.0, smoothstep(0.1, 0.6, fine.tone.y)) *
                 mix(0.65, 1.0, smoothstep(0.1, 0.6, broad.tone.y));
    float patches = broad.tone.y + 0.35 * (middle.tone.y - 0.5);
    // Bare stone is seldom bare: films of algae, in patches of a hand to an arm.
    vec3 stone = mix(vec3(0.19, 0.155, 0.12), vec3(0.54, 0.45, 0.34), mottle.x) * tone;
    vec3 turf = mix(vec3(0.20, 0.16, 0.06), vec3(0.42, 0.29, 0.13), smoothstep(0.3, 0.8, patches)) * tone;
    vec3 crust = mix(vec3(0.50, 0.20, 0.25), vec3(0.62, 0.38, 0.40), middle.tone.y) * (0.6 + 0.4 * tone);
    vec3 sponge = vec3(0.58, 0.27, 0.07) * (0.7 + 0.5 * middle.tone.y);
    vec3 colour = mix(stone, turf, 0.75 * smoothstep(0.35, 0.85, mottle.y + 0.9 * (patches - 0.5)));
    colour = mix(colour, crust, 0.9 * smoothstep(0.36, 0.56, 0.75 * mottle.z + 0.55 * (middle.tone.y - 0.4)));
    colour = mix(colour, sponge, 0.8 * smoothstep(0.86, 0.94, patches + 0.15 * (fine.tone.y - 0.5)) * step(n.y, 0.6));
    Openness openness = Openness(open.x * mix(0.6, 1.0, pits), open.y * pits);
    if (kFine) {
        Openness mapped = openAt(place, normalize(normal));
        openness = Openness(min(openness.sun, mapped.sun), min(openness.sky, mapped.sky));
    }
    radiance = vec4(seen(litUnder(openness, colour * tint, place, n, 0.0), place), 1.0);
}
