// Fusilier, Caesio teres: bright blue, with a yellow back behind a slanting border, a yellow tail and a pale belly.
// Members as skin.glsl describes them: SkinPoint in, linear Rec. 709 albedo and mirror out.
#ifndef SKIN_FUSILIER_GLSL
#define SKIN_FUSILIER_GLSL
#include "skin_anatomy.glsl"

const Iris kIris = Iris(vec3(0.40, 0.46, 0.50), vec3(0.70, 0.74, 0.70), 0.52, 1.0);
const vec3 kBlue = vec3(0.016, 0.34, 0.84), kDeep = vec3(0.008, 0.17, 0.56), kSky = vec3(0.20, 0.66, 0.92),
           kPale = vec3(0.80, 0.84, 0.86), kYellow = vec3(0.97, 0.62, 0.003);

// Yellow from the middle of the dorsal fin down to the lower edge of the peduncle.
float yellowOf(SkinPoint at) {
    float border = at.y - mix(0.120, -0.044, clamp((at.s - 0.40) / 0.36, 0.0, 1.0));
    float soft = edgeOf(at) + 0.004;
    return falling(-soft, soft, -border) * smoothstep(0.36, 0.44, at.s + 0.25 * at.y) +
           smoothstep(0.755, 0.785, at.s) * falling(-soft, soft, -border);
}

Skin groundOf(SkinPoint at) {
    float yellow = clamp(yellowOf(at), 0.0, 1.0);
    vec3 colour = mix(kPale, kSky, smoothstep(-0.85, -0.50, at.v));
    colour = mix(colour, kBlue, smoothstep(-0.35, 0.10, at.v));
    colour = mix(colour, kDeep, 0.8 * smoothstep(0.55, 1.0, at.v));
    colour = mix(colour, kYellow * ownBetween(at.id, 4u, 0.85, 1.0), yellow);
    Skin skin = skinOf(colour, 0.60, 0.6);
    skin.silver = 0.25 * falling(-0.55, -0.15, at.v) * smoothstep(0.02, 0.06, at.s) * (1.0 - 0.8 * yellow);
    // From near the pale belly prevails over what it mirrors.
    skin.silver *= 1.0 - 0.75 * seenAt(0.05, at.pixel);
    skin.iridescence = 0.10 * (1.0 - yellow);
    return skin;
}

void addDetails(inout Skin skin, SkinPoint at) {
    float on = smoothstep(0.17, 0.24, at.s);
    layScales(skin, at, 0.06, 0.0115, 0.15, on);
    // Rows of scales have pale middles: faint lines along the flank.
    float rows = sin(6.2831853 * girthOf(at, 0.06) / 0.0115);
    skin.albedo *= 1.0 + 0.10 * rows * seenAt(0.0115, at.pixel) * on;
    paintLateralLine(skin, at, 0.058 - 0.040 * smoothstep(0.35, 0.70, at.s), 0.22, 0.22);
    paintGill(skin, at);
    paintNostril(skin, at, vec2(0.048, 0.030), 0.0020);
    // Black at the root of the pectoral fin.
    float spot = line(length((vec2(at.s, at.y) - vec2(0.236, 0.008)) / vec2(0.010, 0.010)), 1.0, at.pixel / 0.010);
    skin.albedo = mix(skin.albedo, kInk, 0.9 * spot);
    skin.silver *= 1.0 - spot;
    shadeUnderFin(skin, at, vec2(0.29, -0.028), vec2(0.055, 0.025));
}

Fin finOf(FinPoint fin, Skin root) {
    float q = fin.q;
    if (fin.part == kCaudal) return Fin(kYellow, 0.92, 17.0, 0.0, 0.35);
    if (fin.part == kFirstDorsal) {
        vec3 colour = mix(mix(kBlue, kSky, 0.5), kYellow, smoothstep(0.15, 0.38, fin.p));
        return Fin(colour, 0.72, 25.0, 0.40, 0.40);
    }
    if (fin.part == kPectoral) return Fin(mix(kPale, vec3(0.85, 0.66, 0.60), 0.5), 0.30, 20.0, 0.0, 0.45);
    return Fin(mix(kPale, kSky, 0.25), 0.45, fin.part == kAnal ? 15.0 : 6.0, 0.2, 0.40);
}
#endif
