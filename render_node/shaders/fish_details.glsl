// What a visitor sees of a scad's skin from near: scales, scutes, gill covers, mouth, eye.
#ifndef FISH_DETAILS_GLSL
#define FISH_DETAILS_GLSL
#include "fish_skin.glsl"

struct Skin {
    vec3 albedo;
    float silver;  // share of guanine mirror
    float iridescence;
    float gloss;
    vec2 tilt;     // of the normal, towards the tail and upwards
    vec2 flicker;  // of the platelets, scale by scale
};

// One pixel's footprint on the skin, body lengths.
struct Footprint {
    float pixel;
    float pixelV;
};

struct Scale {
    float rim;     // 0 in the middle .. 1 at the free edge
    vec2 slope;
    vec2 own;      // two numbers of its own, 0 .. 1
};

// Scales in staggered rows; of those over a point the one nearest the head lies on top. Where they
// are too fine to be seen nothing is searched.
Scale scaleAt(vec2 at, float size, bool isSeen) {
    Scale scale = Scale(0.5, vec2(0.0), vec2(0.5));
    float nearest = 1.0e9;
    float row = floor(at.y / (0.5 * size));
    int lastRow = isSeen ? 1 : -2;
    for (int dj = -1; dj <= lastRow; ++dj) {
        float j = row + float(dj);
        float shift = 0.5 * mod(j, 2.0);
        for (int di = -1; di <= 0; ++di) {
            float i = floor(at.x / size - shift) + float(di);
            uvec2 cell = uvec2(ivec2(int(i), int(j)));
            float own = hash(cell, 0u);
            vec2 centre = vec2((i + shift + 0.44 + 0.12 * own) * size, (j + 0.5) * 0.5 * size);
            vec2 from = (at - centre) / (size * vec2(0.78, 0.62));
            float r = length(from);
            if (r < 1.0 && centre.x < nearest) {
                nearest = centre.x;
                scale = Scale(r, from, vec2(own, fract(own * 61.0)));
            }
        }
    }
    return scale;
}

// The lateral line sinks from the shoulder to the axis, where scutes arm it.
float lateralLineY(float s) { return 0.051 - 0.050 * smoothstep(0.34, 0.60, s); }

void paintScutes(inout Skin skin, float s, float y, Footprint f) {
    float halfHeight = 0.0085 * smoothstep(0.54, 0.68, s) * falling(0.80, 0.84, s);
    float soft = max(0.0016, 0.7 * f.pixel);
    float on = (1.0 - smoothstep(halfHeight - soft, halfHeight + soft, abs(y))) *
               smoothstep(0.54, 0.57, s) * falling(0.81, 0.84, s);
    const float kPitch = 0.0085;
    float detail = clamp(0.4 * kPitch / f.pixel - 0.8, 0.0, 1.0);
    float along = fract((s + 0.35 * abs(y)) / kPitch);
    vec3 plate = vec3(0.34, 0.38, 0.39) * mix(0.85, 0.50 + 0.70 * along, detail);
    skin.albedo = mix(skin.albedo, plate, 0.85 * on);
    skin.silver *= 1.0 - 0.35 * on;
    skin.tilt.y += 0.45 * on * sign(y) * smoothstep(0.0, 0.004, abs(y));
    skin.tilt.x += 0.30 * on * detail * (along - 0.5);
}

// The gill cover: a dark slit behind a lit lip; a fainter line on the cheek; the black spot.
void paintGill(inout Skin skin, float s, float v, float y, Footprint f) {
    float on = falling(0.60, 0.86, abs(v));
    float slit = s - (0.245 - 0.024 * v * v);
    float dark = on * line(slit - 0.002, 0.0030, f.pixel);
    float lip = on * line(slit + 0.006, 0.0050, f.pixel);
    float cheek = s - (0.181 - 0.015 * v * v);
    float fold = falling(0.3, 0.6, abs(v + 0.15)) * line(cheek, 0.0028, f.pixel);
    skin.albedo *= (1.0 - 0.62 * dark) * (1.0 + 0.16 * lip) * (1.0 - 0.25 * fold);
    skin.silver *= (1.0 - 0.65 * dark) * (1.0 - 0.25 * fold);
    float swelling = line(slit - 0.004, 0.004, f.pixel) - line(slit + 0.004, 0.005, f.pixel);
    skin.tilt.x += 0.45 * on * swelling + 0.18 * fold;
    vec2 fromSpot = vec2((s - 0.240) / 0.011, (y - 0.038) / 0.014);
    float spot = line(length(fromSpot), 1.0, f.pixel / 0.012);
    skin.albedo = mix(skin.albedo, kInk, 0.93 * spot);
    skin.silver *= 1.0 - spot;
}

void paintMouth(inout Skin skin, float s, float y, Footprint f) {
    float gape = line(y + 0.62 * s - 0.001, 0.0024, f.pixel) * falling(0.046, 0.056, s);
    float jaw = line(y + 0.50 * s + 0.016, 0.0030, f.pixel) * smoothstep(0.012, 0.03, s) *
                falling(0.07, 0.085, s);
    skin.albedo *= (1.0 - 0.85 * gape) * (1.0 - 0.22 * jaw);
    skin.silver *= (1.0 - 0.9 * gape) * (1.0 - 0.3 * jaw);
    float fromGape = y + 0.62 * s;
    float lips = line(fromGape - 0.005, 0.003, f.pixel) - line(fromGape + 0.004, 0.003, f.pixel);
    skin.tilt.y += 0.5 * lips * falling(0.046, 0.056, s);
    vec2 fromNostril = (vec2(s, y) - vec2(0.052, 0.031)) / vec2(1.0, 0.7);
    float nostril = line(length(fromNostril), 0.0022, f.pixel);
    skin.albedo *= 1.0 - 0.8 * nostril;
}

Skin paintBody(float s, float y, float z, float v, uint id, Footprint f) {
    const float kPitch = 0.0115;
    float detail = clamp(0.45 * kPitch / f.pixel - 0.9, 0.0, 1.0) * smoothstep(0.22, 0.28, s);
    // Over the back and the belly rows follow the skin inwards, where y hardly changes.
    float girth = y + sign(y) * (0.04 - abs(z)) * smoothstep(0.45, 0.85, abs(v));
    Scale scale = scaleAt(vec2(s, girth), kPitch, detail > 0.0);
    float golden = goldenLine(s, v, f.pixelV);

    Skin skin;
    skin.albedo = groundColour(v, 0.10 * detail * (scale.own.x - 0.5), golden, id);
    float rim = smoothstep(0.72, 1.0, scale.rim);
    skin.albedo *= 1.0 + detail * (0.30 * (scale.own.x - 0.5) - 0.22 * rim);
    skin.silver = silverOf(s, v, golden);
    skin.iridescence = 0.22 * smoothstep(0.2, 0.7, v) + 0.12;
    skin.gloss = 0.75;
    skin.tilt = 0.22 * detail * scale.slope;
    skin.flicker = detail * (scale.own - 0.5);

    float lateral = smoothstep(0.25, 0.27, s) * line(y - lateralLineY(s), 0.0014, f.pixel);
    skin.albedo *= 1.0 - 0.30 * lateral;
    skin.silver *= 1.0 - 0.30 * lateral;
    paintScutes(skin, s, y, f);
    paintGill(skin, s, v, y, f);
    paintMouth(skin, s, y, f);

    // The adipose lid veils the eye's surroundings; it is clear, not silver.
    float lid = falling(0.044, 0.064, length((vec2(s, y) - kEye) * vec2(0.80, 1.0)));
    skin.albedo = mix(skin.albedo, vec3(0.42, 0.50, 0.52), 0.40 * lid * falling(0.5, 0.9, v));
    skin.silver *= 1.0 - 0.55 * lid;
    // The dark crown of the head.
    float crown = smoothstep(0.52, 0.85, v) * falling(0.18, 0.26, s);
    skin.albedo = mix(skin.albedo, kBack * 1.3, 0.75 * crown);
    // Beneath the pectoral fin little light arrives.
    vec2 fromRoot = (vec2(s, y) - vec2(0.31, -0.030)) / vec2(0.055, 0.022);
    float under = exp(-dot(fromRoot, fromRoot));
    skin.albedo *= 1.0 - 0.22 * under;
    return skin;
}

// The big eye: pupil, iris and a dark rim on a ball. coverage is 0 outside it.
void paintEye(inout Skin skin, vec2 at, Footprint f, out float coverage, out float pupil) {
    vec2 from = (at - kEye) / kEyeRadius;
    float d = length(from);
    float soft = 0.7 * f.pixel / kEyeRadius;
    coverage = 1.0 - smoothstep(1.0 - soft, 1.0 + soft, d);
    pupil = 1.0 - smoothstep(0.47 - 0.03 - soft, 0.47 + 0.03 + soft, d);
    float angle = atan(from.y, from.x);
    float detail = clamp(0.02 / f.pixel - 1.0, 0.0, 1.0);
    float streaks = 0.5 + 0.5 * sin(angle * 23.0 + 3.0 * sin(angle * 7.0)) * detail;
    vec3 iris = kIris * (0.66 + 0.16 * streaks + 0.25 * falling(0.5, 0.75, d));
    iris *= 1.0 - 0.45 * smoothstep(0.25, 0.95, from.y);  // the upper iris is dusky
    iris = mix(iris, vec3(0.80, 0.72, 0.42), 0.55 * line(d - 0.53, 0.05, 2.0 * soft));
    vec3 eye = mix(iris, vec3(0.002, 0.003, 0.005), pupil);
    eye = mix(eye, vec3(0.010, 0.012, 0.014), 0.88 * smoothstep(0.82, 0.98, d));
    skin.albedo *= 1.0 - 0.40 * (1.0 - smoothstep(1.0, 1.25, d)) * (1.0 - coverage);
    skin.albedo = mix(skin.albedo, eye, coverage);
    float guanine = 0.35 * (1.0 - pupil) * (1.0 - smoothstep(0.80, 0.95, d));
    skin.silver = mix(skin.silver, guanine, coverage);
    skin.iridescence *= 1.0 - coverage;
    skin.gloss = mix(skin.gloss, 1.0, coverage);
    skin.tilt = mix(skin.tilt, 0.85 * from * smoothstep(0.15, 1.0, d), coverage);
    skin.flicker *= 1.0 - coverage;
}
#endif
