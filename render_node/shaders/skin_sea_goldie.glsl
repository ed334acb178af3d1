// Sea goldie, Pseudanthias squamipinnis: orange-gold females with a violet stripe under the eye, rose-violet males.
// Members as skin.glsl describes them: SkinPoint in, linear Rec. 709 albedo and mirror out.
#ifndef SKIN_SEA_GOLDIE_GLSL
#define SKIN_SEA_GOLDIE_GLSL
#include "skin_anatomy.glsl"

const Iris kIris = Iris(vec3(0.30, 0.10, 0.36), vec3(0.95, 0.45, 0.06), 0.50, 1.0);
const vec3 kOrange = vec3(0.96, 0.225, 0.006), kGold = vec3(0.97, 0.44, 0.030), kApricot = vec3(0.96, 0.50, 0.16),
           kRose = vec3(0.66, 0.040, 0.245), kWine = vec3(0.34, 0.016, 0.190), kPink = vec3(0.88, 0.20, 0.48),
           kViolet = vec3(0.52, 0.060, 0.60);

// 0 a female, 1 a male: the largest fish are males.
float maleOf(SkinPoint at) { return smoothstep(0.097, 0.103, at.size); }

// From the eye down to the root of the pectoral fin.
float stripeOf(SkinPoint at) {
    float along = (at.s - 0.10) / 0.125;
    float from = at.y - mix(0.016, -0.024, along);
    return band(from, 0.0075, edgeOf(at)) * smoothstep(0.095, 0.11, at.s) * falling(0.215, 0.235, at.s);
}

vec3 femaleOf(SkinPoint at) {
    vec3 colour = mix(kApricot, kGold, smoothstep(-0.95, -0.35, at.v));
    colour = mix(colour, kOrange, smoothstep(-0.25, 0.55, at.v));
    return mix(colour, kOrange * vec3(0.86, 0.70, 1.0), smoothstep(0.6, 1.0, at.v));
}

vec3 maleGroundOf(SkinPoint at) {
    vec3 colour = mix(kPink, kRose, smoothstep(-0.85, -0.1, at.v));
    colour = mix(colour, kWine, 0.75 * smoothstep(0.35, 1.0, at.v));
    // The face and the throat stay warm.
    return mix(colour, kOrange, 0.55 * falling(0.10, 0.22, at.s) * falling(0.0, 0.6, at.v));
}

Skin groundOf(SkinPoint at) {
    float male = maleOf(at);
    vec3 colour = mix(femaleOf(at) * ownBetween(at.id, 4u, 0.90, 1.08), maleGroundOf(at), male);
    colour = mix(colour, mix(kViolet, kOrange, male), 0.85 * stripeOf(at));
    return skinOf(colour, 0.45, 0.9);
}

void addDetails(inout Skin skin, SkinPoint at) {
    float male = maleOf(at);
    skin.iridescence = 0.06 + 0.10 * male;
    Scale scale = layScales(skin, at, 0.06, 0.0150, 0.15, smoothstep(0.15, 0.24, at.s));
    // A yellow spot on each scale of a female, a violet edge on a male's.
    float seen_ = seenAt(0.015, at.pixel) * smoothstep(0.20, 0.28, at.s);
    float spot = falling(0.15, 0.55, scale.rim), rim = smoothstep(0.70, 0.95, scale.rim);
    skin.albedo = mix(skin.albedo, kGold, 0.35 * seen_ * spot * (1.0 - male) * smoothstep(-0.2, 0.4, at.v));
    skin.albedo = mix(skin.albedo, kViolet, 0.35 * seen_ * rim * male);
    paintLateralLine(skin, at, 0.070 + 0.022 * bell(at.s, 0.34, 0.14) - 0.055 * smoothstep(0.45, 0.66, at.s), 0.22,
                     0.14);
    paintGill(skin, at);
    paintNostril(skin, at, vec2(0.042, 0.036), 0.0024);
    shadeUnderFin(skin, at, vec2(0.28, -0.016), vec2(0.05, 0.036));
}

Fin finOf(FinPoint fin, Skin root) {
    float q = fin.q, male = maleOf(fin.at), lobe = abs(2.0 * fin.p - 1.0);
    if (fin.part == kCaudal) {
        // Dark margins above and below, clear between the lobes.
        vec3 colour = mix(mix(kGold, kOrange, 0.4 * lobe), mix(kRose, kPink, 0.5 * q), male);
        colour = mix(colour, mix(kViolet, kWine, male), 0.85 * smoothstep(0.82, 0.94, lobe) * smoothstep(0.1, 0.4, q));
        return Fin(colour, mix(0.72, 0.90, lobe), 15.0, 0.0, 0.40);
    }
    if (fin.part == kPectoral) {
        // A male has a red spot at the tip.
        vec3 colour = mix(kApricot, mix(kPink, kViolet, 0.3), male);
        float spot = male * bell(q, 0.85, 0.14) * bell(fin.p, 0.30, 0.22);
        return Fin(mix(colour, vec3(0.55, 0.004, 0.03), spot), mix(0.30, 0.45, male) + 0.5 * spot, 17.0, 0.0, 0.45);
    }
    vec3 colour = mix(mix(kGold, kOrange, 0.3 * q), mix(kRose, kPink, 0.6 * q), male);
    if (fin.part == kFirstDorsal) {
        // The long third spine of a male; its rear rays are spotted.
        float third = male * bell(fin.p, 0.17, 0.030) * smoothstep(0.2, 0.7, q);
        colour = mix(colour, kWine, third);
        colour = mix(colour, vec3(0.50, 0.006, 0.06), 0.8 * male * bell(fin.p, 0.78, 0.16) * smoothstep(0.55, 0.85, q));
        colour = mix(colour, kViolet, 0.6 * (1.0 - male) * smoothstep(0.90, 0.96, q));
        return Fin(colour, 0.78 + 0.2 * third, 26.0, 0.45, 0.40);
    }
    colour = mix(colour, kViolet, (0.35 + 0.3 * male) * smoothstep(0.80, 0.95, q));
    return Fin(colour, 0.74, fin.part == kPelvic ? 6.0 : 10.0, 0.0, 0.40);
}
#endif
