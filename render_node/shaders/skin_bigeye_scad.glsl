// Bigeye scad, Selar crumenophthalmus: silver flanks with a golden line. Members as skin.glsl
// describes them: SkinPoint in, linear Rec. 709 albedo and mirror out.
#ifndef SKIN_BIGEYE_SCAD_GLSL
#define SKIN_BIGEYE_SCAD_GLSL
#include "skin_anatomy.glsl"

const Iris kIris = Iris(vec3(0.34, 0.33, 0.27), vec3(0.70, 0.62, 0.36), 0.56, 1.0);
const vec3 kBack = vec3(0.006, 0.030, 0.044), kFlank = vec3(0.46, 0.59, 0.65),
           kBelly = vec3(0.78, 0.80, 0.80), kGold = vec3(0.70, 0.46, 0.050);

float goldenLine(SkinPoint at) {
    return line(at.v - 0.34, 0.075, at.pixelV) * smoothstep(0.24, 0.30, at.s) *
           falling(0.74, 0.83, at.s);
}

Skin groundOf(SkinPoint at) {
    float golden = goldenLine(at);
    float back = smoothstep(0.36, 0.62, at.v);
    vec3 colour = mix(mix(kBelly, kFlank, smoothstep(-0.75, -0.2, at.v)), kBack, back);
    colour = mix(colour, kGold * ownBetween(at.id, 4u, 0.70, 1.15), 0.95 * golden);
    Skin skin = skinOf(colour, 0.70 - 0.35 * back, 0.6);
    skin.silver = 0.98 * falling(0.22, 0.66, at.v) * smoothstep(0.015, 0.05, at.s) *
                  (1.0 - 0.75 * golden);
    // At close range the skin over the platelets is seen as well.
    float near = seenAt(0.034, at.pixel);
    skin.silver *= 1.0 - near * (0.48 + 0.3 * falling(-1.0, -0.6, at.v));
    skin.iridescence = 0.10 + 0.30 * back;
    // The dark crown of the head.
    float crown = smoothstep(0.52, 0.85, at.v) * falling(0.18, 0.26, at.s);
    skin.albedo = mix(skin.albedo, kBack * 1.3, 0.75 * crown);
    return skin;
}

// Shields that arm the rear of the lateral line.
void paintScutes(inout Skin skin, SkinPoint at) {
    const float kPitch = 0.0085;
    float halfHeight = kPitch * smoothstep(0.54, 0.68, at.s) * falling(0.80, 0.84, at.s);
    float soft = max(0.0016, 0.7 * at.pixel);
    float on = band(at.y, halfHeight, soft) * smoothstep(0.54, 0.57, at.s) * falling(0.81, 0.84, at.s);
    float detail = seenAt(kPitch, at.pixel);
    float along = fract((at.s + 0.35 * abs(at.y)) / kPitch);
    vec3 plate = vec3(0.34, 0.38, 0.39) * mix(0.85, 0.50 + 0.70 * along, detail);
    skin.albedo = mix(skin.albedo, plate, 0.85 * on);
    skin.silver *= 1.0 - 0.35 * on;
    skin.tilt.y += 0.45 * on * sign(at.y) * smoothstep(0.0, 0.004, abs(at.y));
    skin.tilt.x += 0.30 * on * detail * (along - 0.5);
}

void addDetails(inout Skin skin, SkinPoint at) {
    float on = smoothstep(0.22, 0.28, at.s);
    layScales(skin, at, 0.06, 0.0115, 0.16, on);
    // Platelets lie in bundles, brighter and duller in streaks along the flank.
    float streak = noise(vec2(at.s * 38.0, at.y * 260.0 + 90.0 * own(at.id, 5u)));
    float leaning = 0.45 + 2.2 * streak * streak * streak * mix(0.5, 1.0, on);
    float seen_ = seenAt(0.010, at.pixel);
    skin.flicker.y += leaning * seen_;
    skin.albedo *= 1.0 + 0.35 * (streak - 0.5) * seen_ * on;
    paintLateralLine(skin, at, 0.051 - 0.050 * smoothstep(0.34, 0.60, at.s), 0.25, 0.30);
    paintScutes(skin, at);
    paintGill(skin, at);
    float spot = line(length((vec2(at.s, at.y) - vec2(0.240, 0.038)) / vec2(0.011, 0.014)), 1.0,
                      at.pixel / 0.012);
    skin.albedo = mix(skin.albedo, kInk, 0.93 * spot);
    skin.silver *= 1.0 - spot;
    paintNostril(skin, at, vec2(0.052, 0.031), 0.0022);
    // The adipose lid veils the eye's surroundings; it is clear, not silver.
    float lid = falling(0.044, 0.064, length((vec2(at.s, at.y) - eyeOfSpecies.xy) * vec2(0.8, 1.0)));
    skin.albedo = mix(skin.albedo, vec3(0.42, 0.50, 0.52), 0.40 * lid * falling(0.5, 0.9, at.v));
    skin.silver *= 1.0 - 0.45 * lid;
    shadeUnderFin(skin, at, vec2(0.31, -0.030), vec2(0.055, 0.022));
}

Fin finOf(FinPoint fin, Skin root) {
    float q = fin.q;
    Fin made = Fin(vec3(0.30, 0.32, 0.28), 0.20 + 0.2 * falling(0.0, 0.4, q), 21.0, 0.0, 0.45);
    if (fin.part == kCaudal) {
        vec3 dusk = vec3(0.055, 0.06, 0.06);
        made.albedo = mix(vec3(0.34, 0.30, 0.12), dusk, 0.75 * smoothstep(0.55, 1.0, q));
        made.opacity = 0.74;
        made.rays = 17.0;
    } else if (fin.part == kFirstDorsal || fin.part == kSecondDorsal) {
        made.albedo = mix(vec3(0.15, 0.17, 0.16), vec3(0.08, 0.09, 0.09), smoothstep(0.4, 1.0, q));
        made.opacity += 0.18 * smoothstep(0.5, 1.0, q);
        made.rays = fin.part == kFirstDorsal ? 8.0 : 26.0;
        made.spined = fin.part == kFirstDorsal ? 1.0 : 0.0;
    } else if (fin.part == kPectoral) {
        made.albedo = vec3(0.42, 0.41, 0.28);
    } else {
        made.rays = fin.part == kAnal ? 25.0 : 6.0;
    }
    return made;
}
#endif
