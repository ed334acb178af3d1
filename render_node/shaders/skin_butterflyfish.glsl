// Threadfin butterflyfish, Chaetodon auriga: white with two sets of dark lines at right angles, a black bar through
// the eye, a yellow rear. Members as skin.glsl describes them: SkinPoint in, linear Rec. 709 albedo and mirror out.
#ifndef SKIN_BUTTERFLYFISH_GLSL
#define SKIN_BUTTERFLYFISH_GLSL
#include "skin_anatomy.glsl"

const Iris kIris = Iris(vec3(0.012, 0.012, 0.014), vec3(0.10, 0.09, 0.07), 0.55, 1.0);
const vec3 kWhite = vec3(0.82, 0.87, 0.77), kYellow = vec3(0.94, 0.58, 0.008), kDusk = vec3(0.045, 0.048, 0.065),
           kBlack = vec3(0.006, 0.006, 0.008);
const float kPitch = 0.052;  // of the lines

// Lines that rise tailwards before a diagonal, and lines that fall tailwards behind it.
float chevrons(SkinPoint at) {
    const float kDiagonal = 0.375;
    float rising = at.s - 0.95 * at.y, sinking = at.s + 1.05 * at.y;
    bool isFront = rising < kDiagonal;
    float across = isFront ? rising : sinking;
    float from = (fract((across - (isFront ? kDiagonal : 0.0)) / kPitch + 0.5) - 0.5) * kPitch;
    float on = isFront ? smoothstep(0.10, 0.16, rising) * smoothstep(0.235, 0.262, at.s)
                       : smoothstep(0.02, 0.08, sinking) * falling(0.60, 0.76, at.s);
    return on * line(from, 0.0075, at.pixel) * falling(0.93, 1.0, abs(at.v));
}

vec3 patternOf(SkinPoint at, float ragged) {
    float soft = edgeOf(at);
    vec3 colour = mix(kWhite, kYellow, smoothstep(0.60, 0.76, at.s + 0.10 * at.y));
    colour = mix(colour, kDusk, 0.80 * ownBetween(at.id, 4u, 0.8, 1.0) * chevrons(at));
    colour = mix(colour, vec3(0.62, 0.66, 0.72), 0.35 * falling(0.05, 0.11, at.s));
    // The bar through the eye: narrow on the nape, broad on the cheek.
    float middle = 0.150 + 0.030 * smoothstep(0.05, 0.14, at.y) + 0.012 * smoothstep(0.0, -0.12, at.y);
    float half_ = mix(0.026, 0.012, smoothstep(-0.04, 0.10, at.y));
    float bar = band(at.s - middle + ragged, half_, soft);
    return mix(colour, kBlack, bar);
}

Skin groundOf(SkinPoint at) {
    return skinOf(patternOf(at, 0.0), 0.50, 0.8);
}

void addDetails(inout Skin skin, SkinPoint at) {
    skin.albedo = patternOf(at, 0.003 * (grain(at, 0.008) - 0.5)) * (0.93 + 0.14 * grain(at, 0.0034));
    skin.iridescence = 0.05;
    layScales(skin, at, 0.05, 0.022, 0.14, smoothstep(0.19, 0.27, at.s));
    paintLateralLine(skin, at, 0.170 * bell(at.s, 0.44, 0.20), 0.28, 0.12);
    paintGill(skin, at);
    paintNostril(skin, at, vec2(0.112, 0.056), 0.0022);
    shadeUnderFin(skin, at, vec2(0.33, -0.020), vec2(0.05, 0.040));
}

Fin finOf(FinPoint fin, Skin root) {
    float q = fin.q, soft = 0.02 + 3.0 * fin.at.pixel;
    if (fin.part == kPectoral) return Fin(vec3(0.60, 0.62, 0.58), 0.24, 15.0, 0.0, 0.5);
    if (fin.part == kPelvic) return Fin(kWhite, 0.88, 6.0, 0.0, 0.3);
    if (fin.part == kCaudal) {
        float bow = q - 0.10 * abs(2.0 * fin.p - 1.0);
        vec3 colour = mix(kYellow, kDusk, 0.8 * band(bow - 0.70, 0.018, soft));
        float clear = smoothstep(0.74, 0.80, bow);
        return Fin(mix(colour, vec3(0.66, 0.68, 0.62), clear), mix(0.94, 0.35, clear), 16.0, 0.0, 0.3);
    }
    bool isDorsal = fin.part == kFirstDorsal;
    float yellow = smoothstep(isDorsal ? 0.42 : 0.05, isDorsal ? 0.66 : 0.30, fin.p);
    vec3 colour = mix(kWhite, kYellow, max(yellow, 0.5 * smoothstep(0.3, 0.8, q) * yellow));
    // The false eye of the dorsal fin; a fine dark hem on both.
    float spot = falling(0.85, 1.15, length(vec2((fin.p - 0.80) / 0.075, (q - 0.64) / 0.17)));
    colour = mix(colour, kBlack, isDorsal ? spot : 0.0);
    colour = mix(colour, kBlack, 0.85 * band(q - 0.955, 0.020, soft) * smoothstep(0.30, 0.55, fin.p));
    colour = mix(root.albedo, colour, smoothstep(0.0, 0.15, q));
    return Fin(colour, 0.93, isDorsal ? 36.0 : 24.0, isDorsal ? 0.46 : 0.12, 0.28);
}
#endif
