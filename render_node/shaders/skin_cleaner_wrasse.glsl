// Cleaner wrasse, Labroides dimidiatus: a black stripe from the snout that widens tailwards, over electric blue.
// Members as skin.glsl describes them: SkinPoint in, linear Rec. 709 albedo and mirror out.
#ifndef SKIN_CLEANER_WRASSE_GLSL
#define SKIN_CLEANER_WRASSE_GLSL
#include "skin_anatomy.glsl"

const Iris kIris = Iris(vec3(0.10, 0.06, 0.02), vec3(0.50, 0.30, 0.06), 0.60, 1.0);
const vec3 kBlue = vec3(0.003, 0.22, 0.84), kPale = vec3(0.07, 0.45, 0.88), kCream = vec3(0.84, 0.68, 0.30),
           kStripe = vec3(0.004, 0.005, 0.010);

// The half-height of the stripe, body lengths: a pencil line on the snout, most of the tail at its root.
float stripeHalf(SkinPoint at) {
    float wide = ownBetween(at.id, 4u, 0.9, 1.1);
    return wide * (0.007 + 0.014 * smoothstep(0.06, 0.40, at.s) + 0.015 * smoothstep(0.40, 0.85, at.s));
}
float stripeMiddle(float s) { return 0.010 + 0.012 * smoothstep(0.0, 0.12, s) - 0.020 * smoothstep(0.15, 0.70, s); }

vec3 wrasseColour(SkinPoint at, float ragged) {
    float soft = edgeOf(at), rear = smoothstep(0.22, 0.62, at.s);
    // Cream to pale blue in front, electric blue behind; the belly stays pale longest.
    vec3 colour = mix(mix(kCream, kPale, smoothstep(0.08, 0.30, at.s)), kBlue, rear);
    colour = mix(colour, mix(kCream, kPale, rear), 0.75 * falling(-0.85, -0.35, at.v) * (1.0 - 0.7 * rear));
    float stripe = band(at.y - stripeMiddle(at.s) + ragged, stripeHalf(at), soft);
    float back = smoothstep(0.80, 0.92, at.v) * smoothstep(0.05, 0.16, at.s) * falling(0.74, 0.82, at.s);
    return mix(colour, kStripe, max(stripe, 0.92 * back));
}

Skin groundOf(SkinPoint at) {
    Skin skin = skinOf(wrasseColour(at, 0.0), 0.5, 0.7);
    skin.iridescence = 0.08;
    return skin;
}

void addDetails(inout Skin skin, SkinPoint at) {
    vec3 colour = wrasseColour(at, 0.004 * (grain(at, 0.010) - 0.5));
    skin.albedo = colour * (0.90 + 0.20 * grain(at, 0.004));
    float dark = falling(0.02, 0.10, colour.g);
    skin.iridescence = 0.10 * (1.0 - dark);
    layScales(skin, at, 0.05, 0.017, 0.14, smoothstep(0.20, 0.28, at.s) * (1.0 - 0.6 * dark));
    paintGill(skin, at);
    paintNostril(skin, at, vec2(0.058, 0.032), 0.0018);
    shadeUnderFin(skin, at, vec2(0.29, -0.010), vec2(0.05, 0.030));
}

Fin finOf(FinPoint fin, Skin root) {
    float q = fin.q, lobe = abs(2.0 * fin.p - 1.0);
    if (fin.part == kCaudal) {
        // The stripe runs to the margin, between blue edges.
        vec3 colour = mix(kStripe, kBlue, smoothstep(0.68, 0.76, lobe + 0.10 * (1.0 - q)));
        return Fin(mix(colour, kPale, 0.8 * smoothstep(0.95, 0.98, q)), 0.92, 14.0, 0.0, 0.30);
    }
    if (fin.part == kPectoral) return Fin(vec3(0.55, 0.66, 0.72), 0.28, 13.0, 0.0, 0.5);
    if (fin.part == kPelvic) return Fin(kPale, 0.70, 6.0, 0.0, 0.35);
    vec3 colour = fin.part == kAnal ? mix(kPale, kBlue, 0.4 + 0.6 * q)
                                    : mix(mix(kPale, kBlue, 0.8), kStripe, falling(0.30, 0.50, q));
    colour = mix(colour, kBlue, smoothstep(0.80, 0.92, q));
    return Fin(colour, 0.88, fin.part == kFirstDorsal ? 20.0 : 12.0, fin.part == kFirstDorsal ? 0.45 : 0.2, 0.32);
}
#endif
