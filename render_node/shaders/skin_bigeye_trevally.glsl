// Bigeye trevally, Caranx sexfasciatus: silver with a blue-green back, dark scutes and a white tip to the second
// dorsal fin. Members as skin.glsl describes them: SkinPoint in, linear Rec. 709 albedo and mirror out.
#ifndef SKIN_BIGEYE_TREVALLY_GLSL
#define SKIN_BIGEYE_TREVALLY_GLSL
#include "skin_anatomy.glsl"

const Iris kIris = Iris(vec3(0.40, 0.38, 0.28), vec3(0.74, 0.68, 0.42), 0.58, 1.0);
const vec3 kBack = vec3(0.030, 0.080, 0.085), kFlank = vec3(0.44, 0.56, 0.58), kBelly = vec3(0.74, 0.80, 0.78),
           kScute = vec3(0.035, 0.042, 0.046);

// Shields along the rear of the lateral line, darker than the flank.
float scutesAt(SkinPoint at) {
    float halfHeight = 0.013 * smoothstep(0.47, 0.66, at.s) * falling(0.79, 0.84, at.s);
    return band(at.y, halfHeight, max(0.0016, 0.7 * at.pixel)) * smoothstep(0.47, 0.52, at.s);
}

Skin groundOf(SkinPoint at) {
    float back = smoothstep(0.25, 0.80, at.v), scutes = scutesAt(at);
    vec3 colour = mix(mix(kBelly, kFlank, smoothstep(-0.80, -0.15, at.v)), kBack, back);
    colour = mix(colour, kScute, 0.85 * scutes);
    Skin skin = skinOf(colour, 0.70 - 0.30 * back, 0.6);
    skin.silver = 0.90 * falling(0.30, 0.85, at.v) * smoothstep(0.015, 0.05, at.s) * (1.0 - 0.8 * scutes);
    // At close range the platelets also reflect the light of the reef and the sand.
    skin.silver *= 1.0 - seenAt(0.034, at.pixel) * (0.50 + 0.3 * falling(-1.0, -0.6, at.v));
    skin.iridescence = 0.08 + 0.22 * back;
    // A small black spot at the top of the gill cover.
    float spot = falling(0.7, 1.15, length((vec2(at.s, at.y) - vec2(0.262, 0.052)) / vec2(0.010, 0.009)));
    skin.albedo = mix(skin.albedo, kInk, 0.95 * spot);
    skin.silver *= 1.0 - spot;
    return skin;
}

void addDetails(inout Skin skin, SkinPoint at) {
    float on = smoothstep(0.23, 0.29, at.s), scutes = scutesAt(at);
    layScales(skin, at, 0.055, 0.0075, 0.12, on * (1.0 - scutes));
    float streak = noise(vec2(at.s * 30.0, at.y * 220.0 + 90.0 * own(at.id, 5u)));
    float seen_ = seenAt(0.010, at.pixel);
    skin.flicker.y += (0.4 + 1.6 * streak * streak * streak) * seen_ * on;
    skin.albedo *= 1.0 + 0.25 * (streak - 0.5) * seen_ * on;
    float along = fract((at.s + 0.4 * abs(at.y)) / 0.0115);
    skin.albedo *= 1.0 + 0.6 * scutes * seenAt(0.0115, at.pixel) * (along - 0.4);
    skin.tilt.y += 0.4 * scutes * sign(at.y) * smoothstep(0.0, 0.004, abs(at.y));
    paintLateralLine(skin, at, 0.072 * (1.0 - smoothstep(0.30, 0.50, at.s)), 0.27, 0.22);
    paintGill(skin, at);
    paintNostril(skin, at, vec2(0.060, 0.045), 0.0020);
    float lid = falling(0.030, 0.046, length((vec2(at.s, at.y) - eyeOfSpecies.xy) * vec2(0.75, 1.0)));
    skin.albedo = mix(skin.albedo, vec3(0.36, 0.43, 0.44), 0.35 * lid);
    skin.silver *= 1.0 - 0.45 * lid;
    shadeUnderFin(skin, at, vec2(0.32, -0.036), vec2(0.06, 0.022));
}

Fin finOf(FinPoint fin, Skin root) {
    float q = fin.q;
    vec3 dusk = vec3(0.055, 0.062, 0.064);
    if (fin.part == kCaudal) {
        float lobe = abs(2.0 * fin.p - 1.0);
        return Fin(mix(vec3(0.16, 0.16, 0.12), 0.4 * dusk, smoothstep(0.5, 0.95, max(q, lobe))), 0.88, 17.0, 0.0, 0.4);
    }
    if (fin.part == kSecondDorsal) {
        float tip = smoothstep(0.72, 0.82, q) * falling(0.14, 0.30, fin.p);
        return Fin(mix(dusk, vec3(0.86, 0.90, 0.88), tip), mix(0.80, 0.95, tip), 20.0, 0.0, 0.4);
    }
    if (fin.part == kFirstDorsal) return Fin(dusk, 0.50, 8.0, 1.0, 0.5);
    if (fin.part == kAnal) return Fin(mix(vec3(0.30, 0.33, 0.32), dusk, smoothstep(0.3, 0.9, q)), 0.72, 17.0, 0.0, 0.4);
    if (fin.part == kPectoral) return Fin(vec3(0.40, 0.42, 0.34), 0.55, 20.0, 0.0, 0.45);
    return Fin(vec3(0.50, 0.55, 0.54), 0.60, 6.0, 0.0, 0.4);
}
#endif
