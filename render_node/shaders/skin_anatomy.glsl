// Details of the heads and flanks of all fish, painted on any skin: gill covers, a mouth, nostrils, the
// lateral line. Places in the coordinates of skin.glsl: s and y in body lengths, v from -1 to 1.
#ifndef SKIN_ANATOMY_GLSL
#define SKIN_ANATOMY_GLSL
#include "skin.glsl"

// The gill cover: a dark slit behind a lit lip, wider as the cover lifts, and the fainter fold of the
// cheek before it.
void paintGill(inout Skin skin, SkinPoint at) {
    float v2 = at.v * at.v, station = gillOfSpecies.x, bow = gillOfSpecies.y;
    float on = falling(0.62, 0.90, abs(at.v + 0.08));
    float slit = at.s - (station - bow * v2);
    float width = 0.0026 + 0.0020 * at.gill;
    float dark = on * line(slit - 0.7 * width, width, at.pixel);
    float lip = on * line(slit + 0.006, 0.0050, at.pixel);
    float cheek = at.s - (0.74 * station - 0.5 * bow * v2);
    float fold = falling(0.3, 0.6, abs(at.v + 0.15)) * line(cheek, 0.0026, at.pixel);
    skin.albedo *= (1.0 - (0.50 + 0.25 * at.gill) * dark) * (1.0 + 0.14 * lip) * (1.0 - 0.20 * fold);
    skin.silver *= (1.0 - 0.65 * dark) * (1.0 - 0.25 * fold);
    float swelling = line(slit - 0.004, 0.004, at.pixel) - line(slit + 0.004, 0.005, at.pixel);
    skin.tilt.x += (0.45 + 0.35 * at.gill) * on * swelling + 0.15 * fold;
}

// 1 on teeth that stand behind the lips; depth: from the lips (0) to the bottom of the mouth (1).
float pointedTeeth(SkinPoint at, float depth) {
    float along = 115.0 * (abs(at.z) + 0.7 * at.s);
    float across = abs(2.0 * fract(along) - 1.0);
    float blade = falling(-0.03, 0.03, depth - 0.30 * across) * smoothstep(0.015, 0.04, depth);
    return mix(0.30 * falling(0.0, 0.30, depth), blade, seenAt(0.010, at.pixel));
}

// The flesh behind the lips, darker the deeper, with the teeth that the species shows.
void paintInside(inout Skin skin, SkinPoint at) {
    float depth = (at.mouth - kLips) / (1.0 - kLips);
    float on = at.mouth > kLips ? 1.0 : 0.0;
    vec3 flesh = mix(vec3(0.30, 0.085, 0.070), vec3(0.010, 0.003, 0.004), smoothstep(0.0, 0.7, depth));
    float pointed = lipsOfSpecies.y == 1.0 ? pointedTeeth(at, depth) : 0.0;
    float plates = lipsOfSpecies.y == 2.0 ? falling(0.30, 0.38, depth) : 0.0;
    flesh = mix(flesh, vec3(0.70, 0.69, 0.62), max(pointed, 0.8 * plates));
    skin.albedo = mix(skin.albedo, flesh, on);
    skin.silver *= 1.0 - on;
    skin.iridescence *= 1.0 - on;
    skin.gloss = mix(skin.gloss, 0.25 * falling(0.1, 0.6, depth), on);
    skin.tilt *= 1.0 - on;
}

// The lips: a dark rim where they meet, and a paler swelling behind it.
void paintLips(inout Skin skin, SkinPoint at) {
    float width = lipsOfSpecies.x;
    float rim = line(at.lips, 0.6 * width, at.pixel);
    float swelling = line(at.lips - 1.6 * width, 1.1 * width, at.pixel);
    skin.albedo *= (1.0 - 0.75 * rim) * (1.0 + 0.22 * swelling);
    skin.silver *= (1.0 - 0.9 * rim) * (1.0 - 0.35 * swelling);
    skin.gloss = mix(skin.gloss, 0.7, 0.5 * swelling);
}

void paintNostril(inout Skin skin, SkinPoint at, vec2 place, float size) {
    vec2 from = (vec2(at.s, at.y) - place) / vec2(1.0, 0.7);
    float hole = line(length(from), size, at.pixel);
    skin.albedo *= 1.0 - 0.8 * hole;
    skin.silver *= 1.0 - 0.8 * hole;
}

// A row of pores at height y; nothing before station `from`.
void paintLateralLine(inout Skin skin, SkinPoint at, float y, float from, float depth) {
    float on = smoothstep(from, from + 0.03, at.s) * falling(0.78, 0.84, at.s);
    float pores = 0.7 + 0.3 * cos(6.2831853 * at.s / 0.011) * seenAt(0.011, at.pixel);
    float dark = on * pores * line(at.y - y, 0.0014, at.pixel);
    skin.albedo *= 1.0 - depth * dark;
    skin.silver *= 1.0 - depth * dark;
    skin.tilt.y += 0.25 * on * line(at.y - y + 0.002, 0.002, at.pixel);
}

// Beneath the pectoral fin little light arrives.
void shadeUnderFin(inout Skin skin, SkinPoint at, vec2 root, vec2 size) {
    vec2 from = (vec2(at.s, at.y) - root) / size;
    skin.albedo *= 1.0 - 0.25 * exp(-dot(from, from));
}
#endif
