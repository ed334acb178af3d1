// Blacktip reef shark, Carcharhinus melanopterus: grey bronze above, white below, black tips of the
// fins. Members as skin.glsl describes them: SkinPoint in, linear Rec. 709 albedo and mirror out.
#ifndef SKIN_BLACKTIP_REEF_SHARK_GLSL
#define SKIN_BLACKTIP_REEF_SHARK_GLSL
#include "skin_anatomy.glsl"

const Iris kIris = Iris(vec3(0.24, 0.20, 0.11), vec3(0.36, 0.30, 0.16), 0.60, 0.38);
const vec3 kBronze = vec3(0.180, 0.146, 0.118), kWhite = vec3(0.54, 0.52, 0.52);

// The border of bronze and white, and the pale wedge that rises along the flank.
vec3 counterShaded(SkinPoint at, float ragged) {
    float s = at.s, v = at.v;
    float edge = -0.12 + 0.05 * sin(21.0 * s + ownBetween(at.id, 4u, 0.0, 6.28)) + ragged -
                 0.35 * falling(0.05, 0.13, s);
    float soft = max(0.06, 0.7 * at.pixelV);
    vec3 colour = mix(kWhite, kBronze, smoothstep(edge - soft, edge + 1.6 * soft, v));
    colour = mix(colour, 0.55 * kBronze, smoothstep(0.40, 1.0, v));
    float wedge = bell(s, 0.52, 0.13) * smoothstep(0.27, 0.42, s);
    float pale = band(v + 0.02 - 0.55 * (s - 0.5), 0.09 + 0.09 * wedge, 0.06);
    return mix(colour, 0.82 * kWhite, 0.80 * pale * wedge);
}

Skin groundOf(SkinPoint at) { return skinOf(counterShaded(at, 0.0), 0.25, 0.35); }

void addDetails(inout Skin skin, SkinPoint at) {
    skin.albedo = counterShaded(at, 0.07 * (grain(at, 0.030) - 0.5));
    // Denticles: a satin whose grain runs tailwards; clouds of shade under it.
    float satin = noise(vec2(at.s * 260.0, girthOf(at, 0.065) * 900.0)) - 0.5;
    float seen_ = seenAt(0.0030, at.pixel);
    float cloud = grain(at, 0.060) - 0.5;
    skin.albedo *= 1.0 + 0.10 * satin * seen_ + 0.14 * cloud + 0.10 * (grain(at, 0.009) - 0.5);
    skin.tilt.y += 0.16 * satin * seen_;
    skin.gloss += 0.10 * satin * seen_;
    // Five gill slits, each a fold with a dark mouth and a lit hind lip.
    for (int i = 0; i < 5; ++i) {
        float k = float(i);
        float from = at.s - 0.193 - 0.0125 * k - 0.16 * abs(at.y + 0.004);
        float on = falling(0.020, 0.031, abs(at.y + 0.002 - 0.001 * k));
        skin.albedo *= 1.0 - 0.88 * on * line(from, 0.0016 + 0.0014 * at.gill, at.pixel);
        skin.albedo *= 1.0 + 0.20 * on * line(from - 0.0042, 0.0022, at.pixel);
        skin.tilt.x -= 0.5 * on * (line(from - 0.0030, 0.0022, at.pixel) - line(from + 0.003, 0.003, at.pixel));
    }
    paintLateralLine(skin, at, 0.034 - 0.030 * smoothstep(0.22, 0.75, at.s), 0.22, 0.14);
    paintNostril(skin, at, vec2(0.030, -0.016), 0.0030);
    // Ampullae of Lorenzini: freckles of pores about the snout.
    float pores = smoothstep(0.78, 0.88, grain(at, 0.0024)) * falling(0.05, 0.08, at.s);
    skin.albedo *= 1.0 - 0.4 * pores;
}

Fin finOf(FinPoint fin, Skin root) {
    float p = fin.p, q = fin.q, tip = 0.75;
    vec3 colour = mix(kBronze, 0.62 * kBronze, 0.6 * falling(0.0, 0.3, p));
    if (fin.part == kFirstDorsal) {
        colour = mix(colour, 0.9 * kWhite, 0.85 * smoothstep(0.44, 0.58, q + 0.06 * p));
        tip = 0.66 - 0.06 * p;
    } else if (fin.part == kCaudal) {
        float lower = smoothstep(0.62, 0.80, p);
        colour = mix(colour, 0.8 * kWhite, 0.8 * lower * smoothstep(0.40, 0.60, q));
        tip = mix(mix(0.88, 0.94, smoothstep(0.16, 0.30, p)), 0.69, lower);
    } else if (fin.part == kPectoral || fin.part == kPelvic) {
        colour = mix(colour, 0.9 * kWhite, fin.under);
        tip = fin.part == kPectoral ? 0.88 : 0.76;
    }
    colour = mix(colour, kInk, smoothstep(tip - 0.035, tip + 0.035, q));
    colour = mix(root.albedo, colour, smoothstep(0.0, 0.25, q));
    // A notch parts the tip of the upper lobe from the rest of the tail.
    vec2 inNotch = mat2(0.35, 0.94, -0.94, 0.35) * (vec2(fin.at.s, fin.at.y) - vec2(0.936, 0.104));
    float notch = 0.42 * inNotch.x - abs(inNotch.y);
    float opacity = fin.part == kCaudal ? falling(-0.001, 0.001, notch) : 1.0;
    return Fin(colour, opacity, 0.0, 0.0, 0.0);
}
#endif
