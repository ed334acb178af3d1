// Coral grouper, Cephalopholis miniata: red with bright blue dots, on the fins too. Members as skin.glsl describes
// them: SkinPoint in, linear Rec. 709 albedo and mirror out.
#ifndef SKIN_CORAL_GROUPER_GLSL
#define SKIN_CORAL_GROUPER_GLSL
#include "skin_anatomy.glsl"

const Iris kIris = Iris(vec3(0.60, 0.10, 0.015), vec3(0.90, 0.45, 0.10), 0.45, 1.0);
const vec3 kRed = vec3(0.78, 0.042, 0.010), kDeep = vec3(0.36, 0.016, 0.010), kLight = vec3(0.88, 0.15, 0.040),
           kDot = vec3(0.010, 0.36, 0.92);
const float kPitch = 0.040;  // of the dots, body lengths

// How much of a point is dot, and of the dark ring about it: one dot in each cell, out of its middle.
vec2 dotsAt(vec2 at, uint id, float pixel) {
    vec2 cell = floor(at / kPitch);
    vec2 found = vec2(0.0);
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
            ivec2 here = ivec2(cell) + ivec2(i, j) + 4096;
            vec2 shift = vec2(hash(uvec2(here), 11u), hash(uvec2(here), 12u)) - 0.5;
            vec2 row = vec2(0.5 * mod(cell.y + float(j), 2.0), 0.0);
            vec2 middle = (cell + vec2(i, j) + 0.5 + 0.5 * shift + row) * kPitch;
            float radius = 0.0068 * (0.75 + 0.5 * hash(uvec2(here), 13u)) * ownBetween(id, 4u, 0.9, 1.1);
            float d = length(at - middle), soft = 0.6 * pixel + 0.0012;
            found.x = max(found.x, falling(radius - soft, radius + soft, d));
            found.y = max(found.y, falling(radius + 0.003 - soft, radius + 0.003 + soft, d));
        }
    return found;
}

vec3 dotted(vec3 colour, vec2 at, uint id, float pixel) {
    vec2 dots = dotsAt(at, id, pixel);
    colour = mix(colour, 0.35 * kDeep, 0.75 * dots.y);
    return mix(colour, kDot, dots.x);
}

vec3 redOf(SkinPoint at) {
    vec3 colour = mix(kLight, kRed, smoothstep(-0.90, -0.20, at.v));
    colour = mix(colour, kDeep, 0.75 * smoothstep(0.45, 1.0, at.v));
    // Broad faint bars, as it sits.
    float bars = bell(fract(at.s / 0.15 - 0.1 * at.v) - 0.5, 0.0, 0.22) * smoothstep(0.30, 0.40, at.s);
    return mix(colour, kDeep, 0.30 * bars * own(at.id, 5u) * smoothstep(-0.4, 0.5, at.v));
}

Skin groundOf(SkinPoint at) {
    vec3 colour = redOf(at);
    colour = dotted(colour, vec2(at.s + (at.z < 0.0 ? 0.013 : 0.0), girthOf(at, 0.085)), at.id, at.pixel);
    return skinOf(colour, 0.45, 0.7);
}

void addDetails(inout Skin skin, SkinPoint at) {
    skin.albedo *= 0.90 + 0.20 * grain(at, 0.005);
    layScales(skin, at, 0.08, 0.013, 0.14, smoothstep(0.16, 0.26, at.s));
    paintLateralLine(skin, at, 0.085 * bell(at.s, 0.42, 0.25), 0.32, 0.14);
    paintGill(skin, at);
    // A large mouth: the jaw ends below the eye.
    paintNostril(skin, at, vec2(0.066, 0.056), 0.0026);
    shadeUnderFin(skin, at, vec2(0.38, -0.030), vec2(0.07, 0.055));
}

Fin finOf(FinPoint fin, Skin root) {
    float q = fin.q;
    if (fin.part == kPectoral) {
        vec3 colour = mix(vec3(0.70, 0.085, 0.020), vec3(0.80, 0.24, 0.040), q);
        return Fin(colour, 0.62, 17.0, 0.0, 0.45);
    }
    vec3 colour = mix(kRed, kDeep, 0.35 + 0.40 * q);
    if (fin.part == kPelvic) return Fin(mix(kRed, kDot, 0.6 * smoothstep(0.92, 0.97, q)), 0.88, 6.0, 0.0, 0.35);
    colour = dotted(colour, vec2(fin.at.s, fin.at.y), fin.at.id, fin.at.pixel);
    // A blue hem, within a dark one.
    colour = mix(colour, kInk, 0.8 * smoothstep(0.86, 0.91, q));
    colour = mix(colour, kDot, smoothstep(0.935, 0.965, q));
    bool isDorsal = fin.part == kFirstDorsal;
    return Fin(colour, 0.93, isDorsal ? 24.0 : 15.0, isDorsal ? 0.52 : (fin.part == kAnal ? 0.2 : 0.0), 0.34);
}
#endif
