// Details of the heads and flanks of all fish, painted on any skin: gill covers, a mouth, nostrils, the
// lateral line. Places in the coordinates of skin.glsl: s and y in body lengths, v from -1 to 1.
#ifndef SKIN_ANATOMY_GLSL
#define SKIN_ANATOMY_GLSL
#include "skin.glsl"

// The gill cover: a dark slit behind a lit lip, and the fainter fold of the cheek before it.
// station: of the slit at mid-height; bow: how much further forward it is at back and belly.
void paintGill(inout Skin skin, SkinPoint at, float station, float bow) {
    float v2 = at.v * at.v;
    float on = falling(0.62, 0.90, abs(at.v + 0.08));
    float slit = at.s - (station - bow * v2);
    float dark = on * line(slit - 0.002, 0.0030, at.pixel);
    float lip = on * line(slit + 0.006, 0.0050, at.pixel);
    float cheek = at.s - (0.74 * station - 0.5 * bow * v2);
    float fold = falling(0.3, 0.6, abs(at.v + 0.15)) * line(cheek, 0.0026, at.pixel);
    skin.albedo *= (1.0 - 0.60 * dark) * (1.0 + 0.14 * lip) * (1.0 - 0.20 * fold);
    skin.silver *= (1.0 - 0.65 * dark) * (1.0 - 0.25 * fold);
    float swelling = line(slit - 0.004, 0.004, at.pixel) - line(slit + 0.004, 0.005, at.pixel);
    skin.tilt.x += 0.45 * on * swelling + 0.15 * fold;
}

// The gape, from the front of the snout (at height `front`) back to a corner (s, y), with lips.
void paintMouth(inout Skin skin, SkinPoint at, float front, vec2 corner, float width) {
    float from = at.y - mix(front, corner.y, clamp(at.s / corner.x, 0.0, 1.0));
    float on = falling(corner.x - 0.004, corner.x + 0.004, at.s);
    float gape = on * line(from, width, at.pixel);
    skin.albedo *= 1.0 - 0.85 * gape;
    skin.silver *= 1.0 - 0.90 * gape;
    float lips = line(from - 2.0 * width, 1.3 * width, at.pixel) -
                 line(from + 2.0 * width, 1.3 * width, at.pixel);
    skin.tilt.y += 0.5 * on * lips;
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
