// Clownfish, Amphiprion ocellaris: orange, three white bars with thin black borders. Members as
// skin.glsl describes them: SkinPoint in, linear Rec. 709 albedo and mirror out.
#ifndef SKIN_CLOWNFISH_GLSL
#define SKIN_CLOWNFISH_GLSL
#include "skin_anatomy.glsl"

const Iris kIris = Iris(vec3(0.58, 0.14, 0.012), vec3(0.85, 0.33, 0.05), 0.52, 1.0);
const vec3 kOrange = vec3(0.92, 0.165, 0.006), kDeep = vec3(0.68, 0.070, 0.003),
           kLight = vec3(0.97, 0.31, 0.030), kWhite = vec3(0.84, 0.86, 0.86);

// How far outside the nearest bar, body lengths. Bars are drawn over back and belly too: their
// bulges end where the flank does.
float outsideBars(SkinPoint at) {
    float v = at.v, v2 = v * v;
    float wide = ownBetween(at.id, 4u, 0.85, 1.15);
    float bulge = bell(v, 0.08, 0.36) * ownBetween(at.id, 6u, 0.7, 1.3);
    float head = abs(at.s - 0.207 - 0.012 * (1.0 - v2) - 0.014 * v) - 0.026 * wide * (1.0 - 0.15 * v);
    float flank = abs(at.s - 0.466 + 0.022 * bulge - 0.026 * v) - (0.029 + 0.030 * bulge) * wide;
    float root = abs(at.s - 0.752 + 0.006 * v2) - 0.021 * wide;
    return min(head, min(flank, root));
}

float raggedBars(SkinPoint at) {
    float seen_ = seenAt(0.016, at.pixel);
    if (seen_ <= 0.0) return outsideBars(at);
    vec2 cell = vec2(at.s, at.y) * 75.0 + 17.0 * own(at.id, 7u);
    return outsideBars(at) + seen_ * (0.0045 * (noise(cell) - 0.5) + 0.002 * (noise(2.7 * cell) - 0.5));
}

void paintBars(inout vec3 colour, float outside, SkinPoint at) {
    float soft = edgeOf(at);
    float rim = ownBetween(at.id, 5u, 0.007, 0.013);
    // A rim thinner than a pixel grows fainter.
    colour = mix(colour, kInk, falling(rim - soft, rim + soft, outside) * min(1.0, 2.2 * rim / at.pixel));
    colour = mix(colour, kWhite, falling(-soft, soft, outside));
}

Skin groundOf(SkinPoint at) {
    vec3 colour = mix(kLight, kOrange, smoothstep(-0.95, -0.2, at.v));
    colour = mix(colour, kDeep, 0.85 * smoothstep(0.40, 1.0, at.v));
    colour = mix(colour, kLight, 0.55 * bell(at.s, 0.02, 0.06) * falling(0.1, 0.6, at.v));
    paintBars(colour, outsideBars(at), at);
    return skinOf(colour, 0.45, 0.9);
}

void addDetails(inout Skin skin, SkinPoint at) {
    float outside = raggedBars(at);
    vec3 colour = mix(kLight, kOrange, smoothstep(-0.95, -0.2, at.v));
    colour = mix(colour, kDeep, 0.85 * smoothstep(0.40, 1.0, at.v));
    colour = mix(colour, kLight, 0.55 * bell(at.s, 0.02, 0.06) * falling(0.1, 0.6, at.v));
    paintBars(colour, outside, at);
    // Pearly shades in the white, freckles of soot on the back.
    float white = falling(-0.004, 0.004, outside);
    colour *= 1.0 - 0.10 * white * (1.0 - smoothstep(-0.03, -0.004, outside)) * abs(at.v);
    float soot = smoothstep(0.62, 0.75, grain(at, 0.006)) * smoothstep(0.5, 0.95, at.v);
    skin.albedo = colour * (1.0 - 0.5 * soot * ownBetween(at.id, 8u, 0.0, 1.0));
    skin.iridescence = 0.05;
    layScales(skin, at, 0.07, 0.0165, 0.15, smoothstep(0.15, 0.24, at.s) * (1.0 - 0.5 * white));
    paintLateralLine(skin, at, 0.085 + 0.03 * bell(at.s, 0.45, 0.15) - 0.02 * smoothstep(0.5, 0.66, at.s), 0.25, 0.16);
    paintGill(skin, at);
    paintNostril(skin, at, vec2(0.040, 0.040), 0.0026);
    shadeUnderFin(skin, at, vec2(0.34, -0.014), vec2(0.05, 0.045));
}

Fin finOf(FinPoint fin, Skin root) {
    float q = fin.q;
    bool isMedian = fin.part == kFirstDorsal || fin.part == kAnal || fin.part == kSecondDorsal;
    vec3 ground = isMedian ? root.albedo : kOrange;
    float band_ = fin.part == kPectoral ? 0.74 : 0.72;
    float inky = smoothstep(band_, band_ + 0.07, q);
    vec3 colour = mix(mix(ground, kLight, 0.35 * q), kInk, inky);
    colour = mix(colour, vec3(0.72, 0.76, 0.80), smoothstep(0.93, 0.965, q));
    float opacity = fin.part == kPectoral ? mix(0.66, 0.90, inky) : mix(0.86, 0.94, inky);
    float rays = fin.part == kFirstDorsal ? 26.0 : (fin.part == kPelvic ? 6.0 : 16.0);
    return Fin(colour, opacity, rays, fin.part == kFirstDorsal ? 0.46 : 0.0, 0.40);
}
#endif
