// The painted skins of the fish of the reef, a function each for the body and one for all their fins.
// Coordinates as in fish_skin.glsl: s from nose 0 to tail tip 1, y up, v from belly -1 to back +1; on
// a fin p along its base and q from base to edge. Drawn after the field guides' descriptions.
#ifndef REEF_SKINS_GLSL
#define REEF_SKINS_GLSL
#include "fish_skin.glsl"

// SkinPattern of common/body/fish_skin.h
const uint kClownfish = 2u, kMoorishIdol = 3u, kBlueTang = 4u, kParrotfish = 5u, kTrumpetfish = 6u,
           kBlacktip = 7u;
// CagePart of common/body/fish_body.h
const uint kCaudal = 1u, kFirstDorsal = 2u, kSecondDorsal = 3u, kAnal = 4u, kPelvic = 5u,
           kPectoral = 6u;

layout(location = 3) uniform uint pattern;
layout(location = 4) uniform vec3 eyeOfSpecies;    // s, y and radius, body lengths
layout(location = 5) uniform vec3 groundColours[3];  // back, flank, belly: the plain skin

struct Paint {
    vec3 albedo;
    float gloss;
};

float bump(float x, float middle, float width) {
    float t = (x - middle) / width;
    return exp(-t * t);
}
// 1 where |x| < half, softly.
float bar(float x, float half_, float soft) { return falling(half_ - soft, half_ + soft, abs(x)); }
float own(uint id, uint what) { return hash(uvec2(id, what), 11u); }
float grain(float s, float y, float cells) {
    vec2 at = vec2(s, y) * cells;
    uvec2 cell = uvec2(ivec2(floor(at)) + 4096);
    vec2 t = smoothstep(0.0, 1.0, fract(at));
    float below = mix(hash(cell, 3u), hash(cell + uvec2(1u, 0u), 3u), t.x);
    float above = mix(hash(cell + uvec2(0u, 1u), 3u), hash(cell + uvec2(1u, 1u), 3u), t.x);
    return mix(below, above, t.y);
}

Paint plainSkin(float v) {
    vec3 colour = mix(groundColours[2], groundColours[1], smoothstep(-0.75, -0.2, v));
    return Paint(mix(colour, groundColours[0], smoothstep(0.30, 0.75, v)), 0.5);
}

Paint clownfishSkin(float s, float v, float y, uint id, float soft) {
    vec3 colour = mix(vec3(0.98, 0.30, 0.025), vec3(0.93, 0.155, 0.006), smoothstep(-0.9, -0.1, v));
    colour = mix(colour, vec3(0.70, 0.075, 0.003), smoothstep(0.5, 1.0, v));
    float wide = mix(0.85, 1.15, own(id, 1u));
    float head = abs(s - 0.207 + 0.020 * v * v) - 0.026 * wide;
    float flank = abs(s - 0.462 + 0.028 * bump(v, 0.1, 0.35)) - (0.024 + 0.012 * bump(v, 0.1, 0.4)) * wide;
    float root = abs(s - 0.752) - 0.021 * wide;
    float outside = min(head, min(flank, root)) + 0.004 * (grain(s, y, 90.0) - 0.5);
    float rim = mix(0.007, 0.013, own(id, 2u));
    colour = mix(colour, kInk, falling(rim - soft, rim + soft, outside));
    return Paint(mix(colour, vec3(0.86, 0.87, 0.84), falling(-soft, soft, outside)), 0.55);
}

Paint moorishIdolSkin(float s, float v, float y, float soft) {
    float lean = s - 0.030 * v + 0.035 * v * v;
    float slant = s + 0.075 * v - 0.018 * (1.0 - v * v);
    float front = smoothstep(0.121 - soft, 0.121 + soft, lean) * falling(0.336 - soft, 0.336 + soft, slant);
    float rear = smoothstep(0.606 - soft, 0.606 + soft, s + 0.03 * v * v) * falling(0.730 - soft, 0.730 + soft, s);
    vec3 lemon = vec3(0.86, 0.60, 0.035);
    vec3 colour = mix(vec3(0.80, 0.80, 0.68), lemon, 0.10 + 0.85 * smoothstep(0.40, 0.56, s) * falling(0.59, 0.60, s));
    colour = mix(colour, lemon, 0.9 * smoothstep(0.715, 0.75, s));
    colour = mix(colour, kInk, max(front, rear));
    colour = mix(colour, vec3(0.55, 0.72, 0.78), 0.8 * line(slant - 0.312, 0.0035, soft));
    colour = mix(colour, vec3(0.60, 0.72, 0.75), line(s - 0.742, 0.006, soft));
    vec2 saddle = vec2((s - 0.070) / 0.036, (y - 0.036 - 0.55 * (s - 0.070)) / 0.026);
    colour = mix(colour, kInk, falling(1.10, 1.24, length(saddle)));
    colour = mix(colour, vec3(0.90, 0.33, 0.015), falling(0.88, 1.02, length(saddle)));
    colour = mix(colour, kInk, falling(-0.55, -0.25, v) * smoothstep(0.035, 0.06, s) * falling(0.14, 0.17, s));
    return Paint(colour * (0.94 + 0.10 * grain(s, y, 300.0)), 0.35);
}

// The painter's palette: from the eye along the back to the tail, round an island of blue.
Paint blueTangSkin(float s, float v, float y, uint id, float soft) {
    vec3 colour = mix(vec3(0.03, 0.20, 0.80), vec3(0.010, 0.085, 0.66), smoothstep(-0.9, -0.2, v));
    colour = mix(colour, vec3(0.006, 0.04, 0.38), smoothstep(0.55, 1.0, v));
    float lower = 0.30 - 0.40 * smoothstep(0.265, 0.355, s) + 0.10 * smoothstep(0.42, 0.66, s) -
                  0.22 * smoothstep(0.66, 0.78, s);
    float upper = 0.90 - 0.15 * smoothstep(0.74, 0.80, s) - 0.45 * falling(0.11, 0.17, s);
    float palette = smoothstep(lower - 0.035, lower + 0.035, v) * falling(upper - 0.03, upper + 0.03, v) *
                    smoothstep(0.100, 0.125, s);
    float t = (v - 0.36) / 0.235;
    float round_ = 0.118 * mix(0.85, 1.15, own(id, 1u)) * (1.0 + 0.15 * t);
    float island = falling(0.93, 1.04, length(vec2((s - 0.475 - 0.028 * t) / round_, t)));
    float black = clamp(palette - island, 0.0, 1.0) * falling(0.83, 0.845, s);
    colour = mix(colour, vec3(0.003, 0.005, 0.018), 0.985 * black);
    float wedge = falling(-soft, soft + 0.006, abs(y) - 0.62 * (s - 0.765));
    return Paint(mix(colour, vec3(0.92, 0.64, 0.012), wedge), 0.5 - 0.2 * black);
}

Paint parrotfishSkin(float s, float v, float y, uint id, float pixel, float soft) {
    vec3 colour = mix(vec3(0.012, 0.27, 0.25), vec3(0.075, 0.40, 0.16), 0.55 * smoothstep(-0.5, 0.6, v));
    colour = mix(colour, vec3(0.16, 0.52, 0.36), 0.8 * smoothstep(0.62, 0.78, s));
    float patch_ = bump(s, 0.58, 0.15 * mix(0.75, 1.3, own(id, 1u))) * bump(v, 0.18, 0.7);
    colour = mix(colour, vec3(0.78, 0.50, 0.035), 0.8 * patch_);
    // Large scales, pink at the rim; beyond sight their mean.
    float body = smoothstep(0.215, 0.255, s + 0.02 * v * v);
    const float kPitch = 0.036;
    vec2 at = vec2(s, y) / vec2(kPitch, 0.6 * kPitch);
    at.x += 0.5 * mod(floor(at.y), 2.0);
    float rim = smoothstep(0.62, 0.95, length((fract(at) - vec2(0.35, 0.5)) * vec2(1.15, 1.7)));
    float seen_ = clamp(0.5 * kPitch / pixel - 1.0, 0.0, 1.0);
    vec3 pink = vec3(0.62, 0.12, 0.15);
    colour = mix(colour, pink, body * mix(0.28, 0.8 * rim, seen_) * (1.0 - 0.4 * smoothstep(0.62, 0.8, s)));
    vec3 head = mix(vec3(0.03, 0.26, 0.30), vec3(0.80, 0.36, 0.12), bump(s, 0.150, 0.088) * bump(v, -0.2, 0.74));
    head = mix(head, vec3(0.16, 0.07, 0.42), 0.9 * falling(0.03, 0.085, s));
    for (int i = 0; i < 2; ++i) {
        float ray = v - (0.33 + 0.23 * float(i)) + 1.3 * (s - 0.12);
        head = mix(head, vec3(0.18, 0.08, 0.50), 0.85 * line(ray, 0.05, 20.0 * pixel) * smoothstep(0.132, 0.145, s));
    }
    colour = mix(head, colour, body);
    float beak = falling(0.86, 1.0, length(vec2(s / 0.024, (y + 0.010) / 0.030)));
    return Paint(mix(colour, vec3(0.50, 0.80, 0.70), beak), 0.6);
}

Paint trumpetfishSkin(float s, float v, float y, float soft) {
    vec3 deep = vec3(0.62, 0.34, 0.006), pale = vec3(0.94, 0.78, 0.22);
    vec3 colour = mix(pale, vec3(0.88, 0.60, 0.012), smoothstep(-0.8, 0.1, v));
    colour = mix(colour, deep, 0.8 * smoothstep(0.45, 1.0, v));
    colour *= 0.90 + 0.18 * grain(s, 3.0 * y, 90.0);
    float along = smoothstep(0.36, 0.42, s) * falling(0.74, 0.80, s) * falling(0.6, 0.95, abs(v));
    colour = mix(colour, pale, 0.55 * along * line(fract(s / 0.042) * 0.042 - 0.021, 0.0045, soft));
    colour = mix(colour, 0.75 * deep, 0.5 * line(v - 0.16, 0.06, 0.02) * smoothstep(0.30, 0.35, s));
    float jaw = line(v + 0.25, 0.22, 0.02) * smoothstep(0.015, 0.03, s) * falling(0.08, 0.105, s);
    return Paint(mix(colour, kInk, 0.85 * jaw), 0.4);
}

Paint blacktipSkin(float s, float v, float y, uint id, float pixel) {
    float wave = 6.283 * own(id, 1u);
    float edge = -0.10 + 0.05 * sin(21.0 * s + wave) + 0.06 * (grain(s, y, 26.0) - 0.5) - 0.35 * falling(0.05, 0.13, s);
    vec3 bronze = vec3(0.225, 0.190, 0.135), white = vec3(0.72, 0.73, 0.70);
    vec3 colour = mix(white, bronze, smoothstep(edge - 0.05, edge + 0.10, v));
    colour = mix(colour, 0.62 * bronze, smoothstep(0.45, 1.0, v));
    float wedge = 0.34 * bump(s, 0.50, 0.14) * smoothstep(0.27, 0.40, s);
    float pale = bar(v + 0.02 - 0.55 * (s - 0.5), 0.10 + 0.25 * wedge, 0.05);
    colour = mix(colour, 0.88 * white, 0.85 * pale * smoothstep(0.30, 0.46, s) * falling(0.60, 0.70, s));
    for (int i = 0; i < 5; ++i) {
        float slit = line(s - 0.193 - 0.0125 * float(i) - 0.15 * abs(y), 0.0022, pixel);
        colour *= 1.0 - 0.85 * slit * falling(0.020, 0.032, abs(y + 0.002 - 0.001 * float(i)));
    }
    return Paint(colour * (0.94 + 0.12 * grain(s, y, 420.0)), 0.3);
}

Paint paintOf(float s, float v, float y, uint id, float pixel) {
    float soft = 0.7 * pixel + 0.003;
    switch (pattern) {
        case kClownfish: return clownfishSkin(s, v, y, id, soft);
        case kMoorishIdol: return moorishIdolSkin(s, v, y, soft);
        case kBlueTang: return blueTangSkin(s, v, y, id, soft);
        case kParrotfish: return parrotfishSkin(s, v, y, id, pixel, soft);
        case kTrumpetfish: return trumpetfishSkin(s, v, y, soft);
        case kBlacktip: return blacktipSkin(s, v, y, id, pixel);
        default: return plainSkin(v);
    }
}

struct Fin {
    vec3 albedo;
    float opacity;
};

Fin clownfishFin(uint part, float p, float q, vec3 skin) {
    float opaque = part == kPectoral ? 0.85 : 0.95;
    vec3 colour = mix(skin, kInk, smoothstep(0.74, 0.82, q));
    return Fin(mix(colour, vec3(0.86, 0.87, 0.84), smoothstep(0.92, 0.96, q)), opaque);
}

Fin moorishIdolFin(uint part, float p, float q, vec3 skin) {
    vec3 milk = vec3(0.84, 0.84, 0.76), lemon = vec3(0.86, 0.60, 0.035);
    if (part == kPectoral) return Fin(vec3(0.50, 0.52, 0.48), 0.35);
    if (part == kPelvic) return Fin(kInk, 0.95);
    if (part == kCaudal) return Fin(mix(kInk, vec3(0.86), smoothstep(0.84, 0.90, q)), 0.95);
    return Fin(mix(skin, milk, smoothstep(0.93, 0.98, q)), 0.95);
}

Fin blueTangFin(uint part, float p, float q) {
    vec3 blue = vec3(0.012, 0.095, 0.68), ink = vec3(0.004, 0.006, 0.02), yellow = vec3(0.93, 0.65, 0.012);
    float lobe = abs(2.0 * p - 1.0);
    if (part == kCaudal) return Fin(mix(yellow, ink, smoothstep(0.74, 0.80, lobe + 0.04 * q)), 0.95);
    if (part == kPectoral) return Fin(mix(blue, yellow, smoothstep(0.60, 0.76, q)), 0.88);
    return Fin(mix(mix(blue, ink, smoothstep(0.78, 0.88, q)), vec3(0.03, 0.22, 0.75), smoothstep(0.95, 0.98, q)), 0.95);
}

Fin parrotfishFin(uint part, float p, float q) {
    vec3 teal = vec3(0.010, 0.32, 0.34), pink = vec3(0.66, 0.15, 0.15), blue = vec3(0.012, 0.18, 0.58);
    float lobe = abs(2.0 * p - 1.0);
    if (part == kCaudal) return Fin(mix(mix(vec3(0.06, 0.44, 0.38), pink, 0.9 * bar(lobe - 0.8, 0.1, 0.05)), blue, smoothstep(0.90, 0.96, q)), 0.92);
    if (part == kPectoral) return Fin(mix(vec3(0.05, 0.40, 0.36), vec3(0.20, 0.06, 0.40), bar(p - 0.16, 0.10, 0.05)), 0.7);
    if (part == kPelvic) return Fin(teal, 0.85);
    return Fin(mix(mix(teal, pink, bar(q - 0.48, 0.24, 0.06)), blue, smoothstep(0.88, 0.94, q)), 0.92);
}

Fin trumpetfishFin(uint part, float p, float q) {
    vec3 lemon = vec3(0.88, 0.62, 0.02);
    if (part == kPectoral) return Fin(lemon, 0.4);
    if (part == kCaudal) return Fin(mix(lemon, kInk, 0.95 * falling(0.13, 0.18, length(vec2(q - 0.55, p - 0.20)))), 0.9);
    if (part == kFirstDorsal) return Fin(lemon, 0.6);
    return Fin(mix(lemon, kInk, 0.92 * bar(q - 0.22, 0.10, 0.05)), 0.75);
}

Fin blacktipFin(uint part, float p, float q) {
    vec3 colour = vec3(0.215, 0.182, 0.13);
    float tip = 0.86;
    if (part == kFirstDorsal) {
        colour = mix(colour, vec3(0.62, 0.62, 0.58), smoothstep(0.42, 0.55, q + 0.05 * p));
        tip = 0.64;
    } else if (part == kCaudal) {
        tip = mix(0.90, 0.69, smoothstep(0.62, 0.80, p));
    } else if (part != kPectoral) {
        tip = 0.75;
    }
    return Fin(mix(colour, kInk, smoothstep(tip - 0.03, tip + 0.03, q)), 1.0);
}

// `skin` is the body's colour at the fin's root.
Fin finOf(uint part, float p, float q, vec3 skin) {
    switch (pattern) {
        case kClownfish: return clownfishFin(part, p, q, skin);
        case kMoorishIdol: return moorishIdolFin(part, p, q, skin);
        case kBlueTang: return blueTangFin(part, p, q);
        case kParrotfish: return parrotfishFin(part, p, q);
        case kTrumpetfish: return trumpetfishFin(part, p, q);
        case kBlacktip: return blacktipFin(part, p, q);
        default: return Fin(skin, 0.8);
    }
}

vec3 irisOf() {
    switch (pattern) {
        case kClownfish: return vec3(0.60, 0.13, 0.01);
        case kMoorishIdol: return vec3(0.10, 0.07, 0.03);
        case kBlueTang: return vec3(0.05, 0.09, 0.25);
        case kParrotfish: return vec3(0.70, 0.32, 0.05);
        case kTrumpetfish: return vec3(0.78, 0.52, 0.03);
        case kBlacktip: return vec3(0.17, 0.15, 0.085);
        default: return kIris;
    }
}
#endif
