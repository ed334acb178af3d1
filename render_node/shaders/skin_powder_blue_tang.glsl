// Powder-blue tang, Acanthurus leucosternon: powder blue with a black face, a white throat and a yellow dorsal fin.
// Members as skin.glsl describes them: SkinPoint in, linear Rec. 709 albedo and mirror out.
#ifndef SKIN_POWDER_BLUE_TANG_GLSL
#define SKIN_POWDER_BLUE_TANG_GLSL
#include "skin_anatomy.glsl"

const Iris kIris = Iris(vec3(0.05, 0.045, 0.05), vec3(0.20, 0.17, 0.12), 0.60, 1.0);
const vec3 kPowder = vec3(0.050, 0.36, 0.86), kDeep = vec3(0.020, 0.20, 0.66), kBlack = vec3(0.004, 0.005, 0.010),
           kWhite = vec3(0.86, 0.88, 0.88), kYellow = vec3(0.96, 0.66, 0.008);

// The mask ends at the gill cover; a white band from the chin to below the pectoral fin lies behind and below it.
vec3 faceOf(vec3 colour, SkinPoint at) {
    float soft = edgeOf(at);
    float rear = at.s - 0.208 - 0.030 * sin(3.0 * at.y + 0.4) + 0.55 * max(at.y - 0.11, 0.0);
    float below = at.y + 0.088 + 0.26 * (at.s - 0.03);
    float throat = falling(-soft, soft, below) * falling(-soft, soft, at.s - 0.315 - 0.9 * (at.y + 0.15)) *
                   smoothstep(0.015, 0.035, at.s);
    colour = mix(colour, kWhite, throat);
    float mask = falling(-soft, soft, rear) * (1.0 - falling(-soft, soft, below));
    colour = mix(colour, kBlack, mask);
    // A white line around the lips.
    float lips = length(vec2(at.s, at.y + 0.010) / vec2(0.030, 0.034));
    return mix(colour, kWhite, 0.85 * line(lips - 1.0, 0.13, at.pixel / 0.030));
}

Skin groundOf(SkinPoint at) {
    float soft = edgeOf(at);
    vec3 colour = mix(kPowder, kDeep, 0.6 * smoothstep(0.35, 1.0, abs(at.v)));
    colour *= ownBetween(at.id, 4u, 0.92, 1.08);
    colour = faceOf(colour, at);
    // Yellow runs from the dorsal fin over the back edge and the peduncle.
    float yellow = smoothstep(-soft, soft, at.s - 0.757 - 0.10 * abs(at.y));
    yellow *= falling(0.80 - soft, 0.80 + soft, at.s);
    yellow = max(yellow, smoothstep(0.955, 0.985, at.v) * smoothstep(0.22, 0.26, at.s));
    colour = mix(colour, kYellow, yellow);
    Skin skin = skinOf(colour, 0.45, 0.6);
    skin.iridescence = 0.12 * (1.0 - yellow);
    return skin;
}

void addDetails(inout Skin skin, SkinPoint at) {
    // Scales too fine to count: a shagreen that catches the light.
    float fine = grain(at, 0.0030), coarse = grain(at, 0.0080);
    skin.albedo *= 0.88 + 0.16 * fine + 0.08 * coarse;
    skin.tilt += 0.13 * (vec2(fine, grain(at, 0.0036)) - 0.5);
    paintLateralLine(skin, at, 0.16 * bell(at.s, 0.40, 0.26), 0.24, 0.14);
    // The spine at the root of the tail, folded into its groove.
    vec2 spine = vec2((at.s - 0.772) / 0.024, at.y / 0.0045);
    float groove = line(length(spine), 1.0, at.pixel / 0.0045);
    skin.albedo = mix(skin.albedo, vec3(0.75, 0.72, 0.50), 0.8 * groove);
    skin.tilt.y += 0.5 * groove * sign(at.y);
    paintGill(skin, at);
    paintNostril(skin, at, vec2(0.098, 0.090), 0.0024);
    shadeUnderFin(skin, at, vec2(0.31, -0.05), vec2(0.06, 0.045));
}

Fin finOf(FinPoint fin, Skin root) {
    float q = fin.q, lobe = abs(2.0 * fin.p - 1.0);
    if (fin.part == kCaudal) {
        // White, with a black bar before the pale hem.
        vec3 colour = mix(kWhite, kBlack, 0.9 * band(q - 0.80, 0.10, 0.04));
        colour = mix(colour, kBlack, 0.9 * smoothstep(0.93, 0.99, lobe) * smoothstep(0.1, 0.3, q));
        return Fin(mix(colour, kPowder, falling(0.02, 0.16, q) * 0.4), 0.92, 16.0, 0.0, 0.30);
    }
    if (fin.part == kFirstDorsal) {
        vec3 colour = mix(kYellow, kBlack, 0.85 * band(q - 0.88, 0.05, 0.025));
        return Fin(mix(colour, kWhite, smoothstep(0.95, 0.98, q)), 0.93, 38.0, 0.24, 0.28);
    }
    if (fin.part == kPectoral) return Fin(mix(kYellow, kWhite, 0.25), 0.45, 16.0, 0.0, 0.4);
    vec3 colour = mix(kWhite, kBlack, 0.8 * band(q - 0.90, 0.04, 0.02));
    return Fin(colour, 0.88, fin.part == kPelvic ? 5.0 : 28.0, 0.10, 0.28);
}
#endif
