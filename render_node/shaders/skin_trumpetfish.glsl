// Trumpetfish, Aulostomus chinensis, yellow phase. Members as skin.glsl describes them: SkinPoint
// in, linear Rec. 709 albedo and mirror out.
#ifndef SKIN_TRUMPETFISH_GLSL
#define SKIN_TRUMPETFISH_GLSL
#include "skin_anatomy.glsl"

const Iris kIris = Iris(vec3(0.78, 0.50, 0.03), vec3(0.92, 0.72, 0.20), 0.45, 1.0);
const vec3 kLemon = vec3(0.80, 0.53, 0.010), kDeep = vec3(0.42, 0.21, 0.005),
           kPale = vec3(0.88, 0.68, 0.16);

Skin groundOf(SkinPoint at) {
    vec3 colour = mix(kPale, kLemon, smoothstep(-0.85, 0.0, at.v));
    colour = mix(colour, kDeep, 0.85 * smoothstep(0.40, 1.0, at.v));
    // Faint pale bars along the trunk, and a deeper line through them.
    float along = smoothstep(0.36, 0.42, at.s) * falling(0.74, 0.80, at.s) * falling(0.6, 0.95, abs(at.v));
    float bar = line(fract(at.s / 0.042) * 0.042 - 0.021, 0.0050, at.pixel);
    colour = mix(colour, kPale, 0.60 * along * bar * ownBetween(at.id, 5u, 0.4, 1.0));
    colour = mix(colour, 0.75 * kDeep, 0.55 * band(at.v - 0.16, 0.05, 0.04) * smoothstep(0.40, 0.46, at.s) *
                                           falling(0.88, 0.92, at.s));
    // The dark stripe of the jaw; the spot where the pelvic fins are rooted.
    float jaw = band(at.v + 0.25, 0.20, 0.08) * smoothstep(0.015, 0.03, at.s) * falling(0.08, 0.11, at.s);
    colour = mix(colour, kInk, 0.85 * jaw);
    colour = mix(colour, vec3(0.55, 0.30, 0.006), 0.5 * band(at.v - 0.1, 0.16, 0.1) *
                                                      smoothstep(0.07, 0.10, at.s) * falling(0.20, 0.24, at.s));
    colour = mix(colour, kInk, 0.9 * line(at.s - 0.604, 0.007, at.pixel) * falling(-0.8, -0.55, at.v));
    Skin skin = skinOf(colour, 0.4, 0.7);
    skin.iridescence = 0.05;
    return skin;
}

void addDetails(inout Skin skin, SkinPoint at) {
    float fine = grain(at, 0.0022);
    float blotch = noise(vec2(at.s * 90.0, at.y * 240.0 + 40.0 * own(at.id, 6u)));
    skin.albedo *= 0.84 + 0.18 * fine + 0.14 * blotch;
    skin.tilt += 0.12 * (vec2(fine, grain(at, 0.0027)) - 0.5);
    // Bony plates of the snout, and a keel behind the eye.
    float snout = falling(0.20, 0.26, at.s);
    skin.tilt.y += 0.35 * snout * (line(at.v - 0.45, 0.10, at.pixelV) - line(at.v + 0.10, 0.12, at.pixelV));
    skin.albedo *= 1.0 - 0.22 * snout * line(at.v - 0.28, 0.06, at.pixelV);
    // Rays about the eye.
    vec2 from = vec2(at.s, at.y) - eyeOfSpecies.xy;
    float rays = 0.5 + 0.5 * sin(9.0 * atan(from.y, from.x));
    skin.albedo *= 1.0 - 0.30 * rays * falling(0.018, 0.030, length(from)) * seenAt(0.01, at.pixel);
    paintGill(skin, at);
    paintNostril(skin, at, vec2(0.222, 0.012), 0.0016);
}

Fin finOf(FinPoint fin, Skin root) {
    vec3 lemon = vec3(0.80, 0.53, 0.02);
    if (fin.part == kPectoral) return Fin(lemon, 0.32, 15.0, 0.0, 0.45);
    if (fin.part == kFirstDorsal) return Fin(mix(root.albedo, kPale, fin.q), 0.55, 9.0, 1.0, 0.5);
    if (fin.part == kCaudal) {
        float low = falling(0.13, 0.18, length(vec2(fin.q - 0.55, fin.p - 0.20)));
        float high = falling(0.13, 0.18, length(vec2(fin.q - 0.55, fin.p - 0.80))) *
                     smoothstep(0.3, 0.7, own(fin.at.id, 4u));
        return Fin(mix(lemon, kInk, 0.95 * max(low, high)), 0.80, 13.0, 0.0, 0.35);
    }
    float dark = band(fin.q - 0.22, 0.10, 0.05) * falling(0.85, 0.96, fin.p);
    if (fin.part == kPelvic) dark *= 0.6;
    float opacity = mix(0.50, 0.92, max(dark, falling(0.2, 0.4, fin.q)));
    return Fin(mix(lemon, kInk, 0.92 * dark), opacity, fin.part == kPelvic ? 6.0 : 26.0, 0.0, 0.4);
}
#endif
