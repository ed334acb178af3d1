// Bullethead parrotfish, Chlorurus spilurus, terminal male: large green scales with pink edges, and
// a beak. Members as skin.glsl describes them: SkinPoint in, linear Rec. 709 albedo and mirror out.
#ifndef SKIN_PARROTFISH_GLSL
#define SKIN_PARROTFISH_GLSL
#include "skin_anatomy.glsl"

const Iris kIris = Iris(vec3(0.70, 0.32, 0.05), vec3(0.85, 0.50, 0.12), 0.45, 1.0);
const vec3 kTeal = vec3(0.012, 0.25, 0.25), kGreen = vec3(0.070, 0.40, 0.17),
           kPink = vec3(0.64, 0.13, 0.16), kViolet = vec3(0.16, 0.07, 0.42),
           kTurquoise = vec3(0.012, 0.46, 0.46);
const float kPitch = 0.036;

float behindHead(SkinPoint at) { return smoothstep(0.215, 0.250, at.s + 0.02 * at.v * at.v); }

vec3 scaleGround(SkinPoint at, float shade) {
    vec3 colour = mix(kTeal, kGreen, 0.60 * smoothstep(-0.5, 0.6, at.v) + 0.30 * (shade - 0.5));
    colour = mix(colour, vec3(0.16, 0.52, 0.36), 0.8 * smoothstep(0.62, 0.78, at.s));
    float patch_ = bell(at.s, 0.58, 0.12 * ownBetween(at.id, 4u, 0.75, 1.3)) * bell(at.v, 0.18, 0.55);
    colour = mix(colour, vec3(0.80, 0.52, 0.040), 0.8 * patch_);
    return mix(colour, vec3(0.10, 0.44, 0.46), 0.6 * falling(-0.95, -0.70, at.v));
}

float pinkness(SkinPoint at) {
    return ownBetween(at.id, 5u, 0.75, 1.0) * (0.85 - 0.35 * smoothstep(0.62, 0.80, at.s));
}

vec3 headColour(SkinPoint at) {
    float s = at.s, v = at.v, soft = 0.02 + 12.0 * at.pixel;
    vec3 colour = mix(vec3(0.025, 0.27, 0.31), vec3(0.10, 0.40, 0.30), smoothstep(0.1, 0.9, v));
    colour = mix(colour, vec3(0.82, 0.36, 0.13), bell(s, 0.150, 0.066) * bell(v, -0.20, 0.55));
    colour = mix(colour, kViolet, 0.9 * falling(0.03, 0.085, s - 0.02 * v));
    // Turquoise lines from the lips, violet rays behind the eye.
    for (int i = 0; i < 2; ++i) {
        float lip = v - (i == 0 ? -0.10 : -0.44) + 1.0 * (s - 0.03);
        colour = mix(colour, kTurquoise, 0.9 * band(lip, 0.055, soft) * smoothstep(0.012, 0.03, s) *
                                             falling(0.09, 0.125, s));
        float ray = v - (0.33 + 0.23 * float(i)) + 1.3 * (s - 0.12) - 0.05 * sin(60.0 * s);
        colour = mix(colour, vec3(0.18, 0.08, 0.50), 0.85 * band(ray, 0.050, soft) *
                                                         smoothstep(0.132, 0.145, s));
    }
    return colour;
}

void paintBeak(inout Skin skin, SkinPoint at) {
    vec3 from = vec3(at.s / 0.024, (at.y + 0.010) / 0.030, at.z / 0.026);
    float beak = falling(0.86, 1.0, length(from));
    // Two plates of fused teeth that meet in the middle, and the gape between the jaws.
    float gape = line(at.y + 0.010, 0.0026, at.pixel) + 0.4 * line(at.z, 0.0014, at.pixel);
    vec3 colour = vec3(0.40, 0.66, 0.58) * (1.0 - 0.75 * min(gape, 1.0));
    colour *= 0.75 + 0.35 * grain(at, 0.003);
    float lips = falling(1.0, 1.35, length(from)) * (1.0 - beak);
    skin.albedo = mix(skin.albedo, kTurquoise, 0.7 * lips);
    skin.albedo = mix(skin.albedo, colour, beak);
    skin.gloss = mix(skin.gloss, 0.9, beak);
    skin.tilt *= 1.0 - beak;
}

Skin groundOf(SkinPoint at) {
    float body = behindHead(at);
    // Scales beyond sight: the mean of green and pink.
    vec3 colour = mix(scaleGround(at, 0.5), kPink, 0.36 * pinkness(at));
    Skin skin = skinOf(mix(headColour(at), colour, body), 0.5, 0.6);
    skin.iridescence = 0.24 * body;
    paintBeak(skin, at);
    return skin;
}

void addDetails(inout Skin skin, SkinPoint at) {
    float body = behindHead(at), detail = seenAt(kPitch, at.pixel);
    Skin made = skinOf(headColour(at), 0.5, 0.6);
    float on = body * detail;
    Scale scale = scaleAt(vec2(at.s, girthOf(at, 0.08)), kPitch, on > 0.0);
    float soft = clamp(0.5 * at.pixel / kPitch, 0.07, 0.3);
    float rim = smoothstep(0.80 - soft, 0.80 + soft, scale.rim);
    vec3 tile = scaleGround(at, scale.own.x);
    // Each scale is deeper at its root, with fine rays, and glows before its rim.
    tile *= 0.62 + 0.42 * smoothstep(0.05, 0.75, scale.rim) + 0.16 * (scale.own.y - 0.5);
    float striae = sin(34.0 * atan(scale.slope.y, scale.slope.x + 1.2)) * seenAt(0.006, at.pixel);
    tile *= 1.0 + 0.07 * striae;
    tile = mix(tile, kPink, pinkness(at) * rim);
    vec3 far = mix(scaleGround(at, 0.5), kPink, 0.36 * pinkness(at));
    made.albedo = mix(made.albedo, mix(far, tile, detail), body);
    made.iridescence = body * mix(0.24, 0.34 * (1.0 - rim), detail);
    made.tilt = 0.34 * on * scale.slope * (1.0 - 0.6 * rim);
    made.albedo *= 1.0 - 0.10 * (1.0 - body) * (grain(at, 0.004) - 0.5);
    paintBeak(made, at);
    paintGill(made, at);
    paintNostril(made, at, vec2(0.078, 0.064), 0.0024);
    shadeUnderFin(made, at, vec2(0.33, 0.01), vec2(0.07, 0.05));
    skin = made;
}

Fin finOf(FinPoint fin, Skin root) {
    float q = fin.q, lobe = abs(2.0 * fin.p - 1.0);
    vec3 teal = vec3(0.010, 0.34, 0.36), pink = vec3(0.68, 0.15, 0.16), blue = vec3(0.012, 0.16, 0.58);
    if (fin.part == kCaudal) {
        vec3 colour = mix(vec3(0.06, 0.46, 0.40), pink, 0.9 * band(lobe - 0.80, 0.10, 0.05));
        colour = mix(colour, blue, max(smoothstep(0.93, 0.97, lobe), 0.8 * smoothstep(0.90, 0.95, q)));
        return Fin(colour, 0.88, 13.0, 0.0, 0.35);
    }
    if (fin.part == kPectoral) {
        vec3 colour = mix(vec3(0.05, 0.42, 0.40), vec3(0.24, 0.07, 0.46), band(fin.p - 0.14, 0.12, 0.05));
        return Fin(colour, 0.50 + 0.30 * falling(0.0, 0.3, fin.p), 15.0, 0.0, 0.45);
    }
    if (fin.part == kPelvic) return Fin(mix(blue, teal, smoothstep(0.0, 0.15, fin.p)), 0.80, 6.0, 0.0, 0.35);
    vec3 colour = mix(teal, pink, band(q - 0.48, 0.24, 0.05));
    colour = mix(colour, blue, max(smoothstep(0.88, 0.93, q), 0.6 * falling(0.03, 0.10, q)));
    return Fin(colour, 0.90, fin.part == kFirstDorsal ? 19.0 : 12.0, fin.part == kFirstDorsal ? 0.47 : 0.25, 0.32);
}
#endif
