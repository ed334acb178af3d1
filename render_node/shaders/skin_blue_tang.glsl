// Blue tang, Paracanthurus hepatus: blue with a black mark like a painter's palette, and a yellow
// tail. Members as skin.glsl describes them: SkinPoint in, linear Rec. 709 albedo and mirror out.
#ifndef SKIN_BLUE_TANG_GLSL
#define SKIN_BLUE_TANG_GLSL
#include "skin_anatomy.glsl"

const Iris kIris = Iris(vec3(0.05, 0.09, 0.25), vec3(0.22, 0.30, 0.55), 0.58, 1.0);
const vec3 kBlue = vec3(0.006, 0.115, 0.62), kDeep = vec3(0.004, 0.050, 0.34),
           kSky = vec3(0.016, 0.20, 0.72), kBlack = vec3(0.003, 0.005, 0.018),
           kYellow = vec3(0.92, 0.64, 0.012);

// From the eye along the back to the tail, with a lower arm from behind the pectoral fin, round an
// island of blue.
float paletteOf(SkinPoint at, float ragged) {
    float s = at.s, v = at.v + ragged;
    float lower = 0.30 - 0.40 * smoothstep(0.265, 0.355, s) + 0.10 * smoothstep(0.42, 0.66, s) -
                  0.22 * smoothstep(0.66, 0.78, s);
    float upper = 0.90 - 0.15 * smoothstep(0.74, 0.80, s) - 0.45 * falling(0.11, 0.17, s);
    float soft = max(0.030, 0.7 * at.pixelV);
    float palette = smoothstep(lower - soft, lower + soft, v) *
                    falling(upper - soft, upper + soft, v) * smoothstep(0.100, 0.125, s);
    float t = (v - 0.36) / 0.235;
    float wide = 0.118 * ownBetween(at.id, 4u, 0.85, 1.15) * (1.0 + 0.15 * t);
    float island = falling(0.92, 1.04, length(vec2((s - 0.475 - 0.028 * t) / wide, t)));
    return clamp(palette - island, 0.0, 1.0) * falling(0.83, 0.845, s);
}

void paintTang(inout Skin skin, SkinPoint at, float ragged) {
    float black = paletteOf(at, ragged);
    vec3 colour = mix(kSky, kBlue, smoothstep(-0.95, -0.3, at.v));
    colour = mix(colour, kDeep, smoothstep(0.55, 1.0, at.v));
    colour = mix(colour, kBlack, 0.985 * black);
    float soft = edgeOf(at);
    float wedge = falling(-soft, soft + 0.004, abs(at.y) - 0.62 * (at.s - 0.765));
    skin.albedo = mix(colour, kYellow, wedge);
    skin.iridescence = 0.30 * (1.0 - black) * (1.0 - wedge);
    skin.gloss = 0.50 - 0.22 * black;
}

Skin groundOf(SkinPoint at) {
    Skin skin = skinOf(kBlue, 0.5, 0.6);
    paintTang(skin, at, 0.0);
    return skin;
}

void addDetails(inout Skin skin, SkinPoint at) {
    paintTang(skin, at, 0.03 * (grain(at, 0.011) - 0.5));
    // Scales too fine to count: a shagreen that catches the light.
    float fine = grain(at, 0.0030), coarse = grain(at, 0.0075);
    skin.albedo *= 0.84 + 0.20 * fine + 0.12 * coarse;
    skin.tilt += 0.14 * (vec2(fine, grain(at, 0.0036)) - 0.5);
    skin.iridescence *= 0.6 + 0.8 * coarse;
    paintLateralLine(skin, at, 0.12 * bell(at.s, 0.40, 0.26), 0.24, 0.18);
    // The spine at the root of the tail, folded into its groove.
    vec2 spine = vec2((at.s - 0.775) / 0.030, at.y / 0.0045);
    float groove = line(length(spine), 1.0, at.pixel / 0.0045);
    skin.albedo = mix(skin.albedo, vec3(0.30, 0.17, 0.008), 0.8 * groove);
    skin.tilt.y += 0.5 * line(length(spine), 0.8, at.pixel / 0.0045) * sign(at.y);
    paintGill(skin, at);
    paintNostril(skin, at, vec2(0.070, 0.060), 0.0024);
    shadeUnderFin(skin, at, vec2(0.31, -0.03), vec2(0.06, 0.045));
}

Fin finOf(FinPoint fin, Skin root) {
    float q = fin.q, lobe = abs(2.0 * fin.p - 1.0);
    if (fin.part == kCaudal) {
        vec3 colour = mix(kYellow, kBlack, smoothstep(0.74, 0.80, lobe + 0.04 * q));
        return Fin(mix(colour, kBlue, smoothstep(0.935, 0.97, lobe)), 0.92, 16.0, 0.0, 0.35);
    }
    if (fin.part == kPectoral) {
        vec3 colour = mix(kBlue, kBlack, 0.8 * band(q - 0.56, 0.10, 0.06));
        return Fin(mix(colour, kYellow, smoothstep(0.60, 0.74, q)), 0.78, 16.0, 0.0, 0.4);
    }
    // The blue under the palette goes on into the fins, up to a black edge with a bright hem.
    vec3 colour = mix(mix(kBlue, kSky, 0.3 * q), kBlack, smoothstep(0.76, 0.86, q));
    colour = mix(colour, kSky, smoothstep(0.945, 0.97, q));
    float spines = fin.part == kFirstDorsal ? 0.30 : 0.14;
    return Fin(colour, 0.90, fin.part == kPelvic ? 4.0 : 29.0, spines, 0.30);
}
#endif
