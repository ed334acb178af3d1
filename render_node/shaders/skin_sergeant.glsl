// Sergeant, Abudefduf vaigiensis: silver, yellow on the back, five black bars. Members as skin.glsl describes them:
// SkinPoint in, linear Rec. 709 albedo and mirror out.
#ifndef SKIN_SERGEANT_GLSL
#define SKIN_SERGEANT_GLSL
#include "skin_anatomy.glsl"

const Iris kIris = Iris(vec3(0.42, 0.38, 0.22), vec3(0.70, 0.62, 0.34), 0.55, 1.0);
const vec3 kSilver = vec3(0.50, 0.73, 0.68), kBelly = vec3(0.76, 0.88, 0.80), kYellow = vec3(0.88, 0.68, 0.020),
           kBar = vec3(0.005, 0.006, 0.010);

// How far outside the nearest bar, body lengths. The bars narrow towards the belly.
float outsideBars(SkinPoint at) {
    float v = at.v, wide = ownBetween(at.id, 4u, 0.88, 1.12) * (1.0 + 0.22 * v);
    float outside = 1.0;
    for (int i = 0; i < 4; ++i) {
        float middle = 0.255 + 0.127 * float(i) + 0.012 * v - 0.014 * (1.0 - v * v);
        outside = min(outside, abs(at.s - middle) - (0.027 - 0.0015 * float(i)) * wide);
    }
    return min(outside, abs(at.s - 0.757) - 0.017 * wide);
}

vec3 patternOf(SkinPoint at, float ragged) {
    float soft = edgeOf(at);
    vec3 colour = mix(kBelly, kSilver, smoothstep(-0.85, -0.25, at.v));
    float yellow = smoothstep(0.20, 0.55, at.v) * smoothstep(0.17, 0.26, at.s) * falling(0.66, 0.78, at.s);
    colour = mix(colour, kYellow, 0.92 * yellow * ownBetween(at.id, 5u, 0.8, 1.0));
    float crown = smoothstep(0.30, 0.85, at.v) * falling(0.16, 0.24, at.s);
    colour = mix(colour, vec3(0.13, 0.18, 0.15), 0.80 * crown);
    float bar = falling(-soft, soft, outsideBars(at) + ragged);
    return mix(colour, kBar, bar * falling(0.90, 1.02, -at.v));
}

Skin groundOf(SkinPoint at) {
    vec3 colour = patternOf(at, 0.0);
    Skin skin = skinOf(colour, 0.55, 0.6);
    float bright = smoothstep(0.05, 0.30, colour.b);
    skin.silver = 0.45 * bright * falling(0.15, 0.45, at.v) * (1.0 - 0.6 * seenAt(0.034, at.pixel));
    skin.iridescence = 0.10 * bright;
    return skin;
}

void addDetails(inout Skin skin, SkinPoint at) {
    float bar = falling(-0.004, 0.004, outsideBars(at));
    skin.albedo = patternOf(at, 0.004 * (grain(at, 0.010) - 0.5));
    layScales(skin, at, 0.07, 0.026, 0.18, smoothstep(0.13, 0.22, at.s) * (1.0 - 0.5 * bar));
    paintLateralLine(skin, at, 0.120 * bell(at.s, 0.40, 0.25), 0.25, 0.14);
    paintGill(skin, at);
    paintNostril(skin, at, vec2(0.052, 0.046), 0.0022);
    // The black spot over the root of the pectoral fin.
    float spot = falling(0.7, 1.1, length((vec2(at.s, at.y) - vec2(0.274, 0.024)) / vec2(0.010, 0.008)));
    skin.albedo = mix(skin.albedo, kInk, 0.9 * spot);
    shadeUnderFin(skin, at, vec2(0.33, -0.015), vec2(0.05, 0.045));
}

Fin finOf(FinPoint fin, Skin root) {
    float q = fin.q, lobe = abs(2.0 * fin.p - 1.0);
    if (fin.part == kPectoral) return Fin(vec3(0.50, 0.54, 0.50), 0.26, 18.0, 0.0, 0.5);
    if (fin.part == kCaudal) {
        vec3 colour = mix(vec3(0.36, 0.42, 0.40), vec3(0.05, 0.06, 0.07), 0.85 * smoothstep(0.55, 0.95, lobe));
        return Fin(colour, 0.80, 15.0, 0.0, 0.35);
    }
    if (fin.part == kPelvic) return Fin(vec3(0.50, 0.55, 0.54), 0.75, 6.0, 0.0, 0.35);
    // The bars end in the foot of the dorsal fin.
    vec3 dusk = fin.part == kFirstDorsal ? vec3(0.15, 0.19, 0.17) : vec3(0.30, 0.36, 0.35);
    vec3 colour = mix(root.albedo, dusk, smoothstep(0.05, 0.55, q));
    return Fin(colour, 0.84, fin.part == kFirstDorsal ? 26.0 : 14.0, fin.part == kFirstDorsal ? 0.55 : 0.15, 0.35);
}
#endif
