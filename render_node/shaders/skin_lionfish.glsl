// Lionfish, Pterois volitans: red-brown and white bars over body, spines and fans. Members as skin.glsl describes
// them: SkinPoint in, linear Rec. 709 albedo and mirror out.
#ifndef SKIN_LIONFISH_GLSL
#define SKIN_LIONFISH_GLSL
#include "skin_anatomy.glsl"

const Iris kIris = Iris(vec3(0.26, 0.050, 0.016), vec3(0.60, 0.34, 0.16), 0.42, 1.0);
const vec3 kRust = vec3(0.34, 0.034, 0.012), kDark = vec3(0.11, 0.012, 0.007), kCream = vec3(0.84, 0.74, 0.54);

// How far into a pale bar, body lengths. Broad and narrow bars take turns; on the head they lean forward.
float paleBars(SkinPoint at) {
    float bend = 0.024 * sin(4.5 * at.v + 6.2831853 * own(at.id, 4u)) + 0.006 * sin(11.0 * at.v + 40.0 * at.s);
    float lean = at.s + 0.35 * bend - mix(0.35, 0.06, smoothstep(0.10, 0.32, at.s)) * at.y;
    const float kPitch = 0.090;
    float t = fract(lean / kPitch + 0.15);
    float broad = abs(t - 0.27) - 0.130, narrow = abs(t - 0.76) - 0.060;
    return -min(broad, narrow) * kPitch;
}

vec3 patternOf(SkinPoint at, float ragged) {
    float soft = edgeOf(at);
    vec3 rust = mix(kRust, kDark, 0.75 * smoothstep(0.0, 0.9, at.v));
    vec3 cream = mix(kCream, vec3(0.62, 0.34, 0.20), 0.5 * smoothstep(0.2, 1.0, at.v));
    float inside = paleBars(at) + ragged;
    float pale = smoothstep(-soft, soft, inside);
    // Dark lines down the middle of the red bars' edges.
    rust = mix(rust, kDark, 0.8 * line(inside + 0.007, 0.004, at.pixel));
    vec3 colour = mix(rust, cream, pale);
    return mix(colour, cream, 0.55 * falling(-0.95, -0.70, at.v));
}

Skin groundOf(SkinPoint at) {
    return skinOf(patternOf(at, 0.0), 0.40, 0.7);
}

void addDetails(inout Skin skin, SkinPoint at) {
    skin.albedo = patternOf(at, 0.004 * (grain(at, 0.009) - 0.5)) * (0.86 + 0.28 * grain(at, 0.005));
    layScales(skin, at, 0.08, 0.011, 0.12, smoothstep(0.22, 0.30, at.s));
    paintGill(skin, at);
    paintNostril(skin, at, vec2(0.052, 0.052), 0.0026);
    shadeUnderFin(skin, at, vec2(0.34, -0.020), vec2(0.06, 0.070));
}

// Bands across the rays of a fan: red-brown and cream, wider outwards.
vec3 banded(float q, float count) {
    float t = fract(count * q * (1.15 - 0.15 * q));
    float cream = smoothstep(0.52, 0.60, t) * falling(0.88, 0.96, t);
    return mix(mix(kRust, kDark, 0.6), kCream, 0.92 * cream);
}

Fin finOf(FinPoint fin, Skin root) {
    float q = fin.q;
    if (fin.part == kPectoral) {
        // Free rays outwards: the membrane ends between them, deepest where two rays part.
        float across = 0.5 + 0.5 * cos(6.2831853 * 13.0 * fin.p);  // 1 on a ray
        float free_ = smoothstep(0.42, 0.62, q - 0.16 * across);
        float opacity = mix(0.80, smoothstep(0.45, 0.75, across), free_);
        return Fin(banded(q, 4.6), opacity, 13.0, 0.0, 0.35);
    }
    if (fin.part == kFirstDorsal) {
        // The membrane, and the spines that stand out of it, banded along their length.
        return Fin(mix(root.albedo, banded(q, 5.0), smoothstep(0.0, 0.12, q)), 0.92, 12.0, 1.0, 0.5);
    }
    if (fin.part == kPelvic) return Fin(banded(q, 4.0), 0.92, 6.0, 0.0, 0.5);
    // Clear fins with rows of dark spots on their rays.
    float rays = fin.part == kCaudal ? 13.0 : 11.0;
    float ray = 0.5 + 0.5 * cos(6.2831853 * rays * fin.p);
    float row = bell(fract(6.0 * q + 0.35 * mod(floor(rays * fin.p + 0.5), 2.0)) - 0.5, 0.0, 0.24);
    float spot = row * smoothstep(0.35, 0.75, ray) * smoothstep(0.10, 0.2, q);
    vec3 colour = mix(vec3(0.66, 0.56, 0.40), kDark, 0.9 * spot);
    colour = mix(root.albedo, colour, smoothstep(0.0, 0.18, q));
    return Fin(colour, mix(0.46, 0.95, max(spot, falling(0.05, 0.25, q))), rays, 0.0, 0.45);
}
#endif
