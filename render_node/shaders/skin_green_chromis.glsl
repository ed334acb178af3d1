// Green chromis, Chromis viridis: pale aqua that flashes green and blue as the fish turns. Members as skin.glsl
// describes them: SkinPoint in, linear Rec. 709 albedo and mirror out.
#ifndef SKIN_GREEN_CHROMIS_GLSL
#define SKIN_GREEN_CHROMIS_GLSL
#include "skin_anatomy.glsl"

const Iris kIris = Iris(vec3(0.16, 0.36, 0.33), vec3(0.50, 0.66, 0.45), 0.58, 1.0);
const vec3 kBack = vec3(0.055, 0.42, 0.30), kAqua = vec3(0.13, 0.78, 0.55), kMint = vec3(0.38, 0.90, 0.68),
           kBelly = vec3(0.72, 0.92, 0.88), kBlue = vec3(0.045, 0.30, 0.80);

vec3 colourOf(SkinPoint at) {
    vec3 colour = mix(kBelly, kAqua, smoothstep(-0.85, -0.20, at.v));
    colour = mix(colour, kMint, 0.55 * bell(at.v, 0.15, 0.35) * smoothstep(0.15, 0.3, at.s));
    // Some fish are bluer, some greener.
    vec3 hue = mix(vec3(0.85, 1.0, 0.82), vec3(0.9, 0.95, 1.15), own(at.id, 4u));
    return mix(colour, kBack, 0.8 * smoothstep(0.40, 0.95, at.v)) * hue;
}

// A line from the eye to the lip.
float bridleOf(SkinPoint at) {
    float from = at.y - mix(0.008, 0.036, clamp(at.s / 0.07, 0.0, 1.0));
    return line(from, 0.0035, at.pixel) * falling(0.058, 0.068, at.s);
}

Skin groundOf(SkinPoint at) {
    Skin skin = skinOf(mix(colourOf(at), kBlue, 0.75 * bridleOf(at)), 0.60, 0.8);
    // Platelets below the colour: it brightens when the fish rolls. From near the colour prevails.
    skin.silver = 0.20 * falling(0.35, 0.85, at.v) * smoothstep(-1.0, -0.6, at.v) * smoothstep(0.05, 0.15, at.s);
    skin.silver *= 1.0 - 0.65 * seenAt(0.06, at.pixel);
    skin.iridescence = 0.14;
    return skin;
}

void addDetails(inout Skin skin, SkinPoint at) {
    float on = smoothstep(0.13, 0.22, at.s);
    Scale scale = layScales(skin, at, 0.065, 0.0205, 0.16, on);
    float seen_ = seenAt(0.0205, at.pixel) * on;
    // A pale spot on each scale, with a darker green edge.
    skin.albedo = mix(skin.albedo, kBelly * vec3(0.8, 1.0, 0.95), 0.35 * seen_ * falling(0.1, 0.6, scale.rim));
    skin.albedo *= 1.0 - 0.25 * seen_ * smoothstep(0.72, 0.98, scale.rim) * vec3(1.0, 0.55, 0.6);
    float lateral = 0.105 + 0.030 * bell(at.s, 0.36, 0.14) - 0.03 * smoothstep(0.42, 0.60, at.s);
    paintLateralLine(skin, at, lateral, 0.23, 0.15);
    paintGill(skin, at);
    paintNostril(skin, at, vec2(0.046, 0.044), 0.0025);
    shadeUnderFin(skin, at, vec2(0.30, -0.010), vec2(0.05, 0.042));
}

Fin finOf(FinPoint fin, Skin root) {
    float q = fin.q, lobe = abs(2.0 * fin.p - 1.0);
    if (fin.part == kCaudal) {
        // Both lobes have a dusky streak.
        vec3 colour = mix(mix(kAqua, kMint, q), kBack * 0.5, 0.7 * band(lobe - 0.86, 0.10, 0.05));
        return Fin(colour, mix(0.50, 0.82, lobe), 15.0, 0.0, 0.40);
    }
    if (fin.part == kPectoral) {
        // A dark spot at the upper end of its root.
        float spot = bell(q, 0.0, 0.16) * bell(fin.p, 0.0, 0.3);
        return Fin(mix(kBelly, kBack * 0.3, spot), 0.28 + 0.5 * spot, 17.0, 0.0, 0.5);
    }
    bool isDorsal = fin.part == kFirstDorsal;
    vec3 colour = mix(root.albedo, mix(kAqua, kBlue, 0.35), smoothstep(0.1, 0.7, q));
    colour = mix(colour, kBlue, 0.6 * smoothstep(0.90, 0.97, q));
    float rays = isDorsal ? 22.0 : (fin.part == kPelvic ? 6.0 : 12.0);
    return Fin(colour, isDorsal ? 0.66 : 0.60, rays, isDorsal ? 0.55 : 0.15, 0.40);
}
#endif
