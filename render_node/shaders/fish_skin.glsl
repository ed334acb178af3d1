// The painted skin of the bigeye scad, Selar crumenophthalmus: a mirror with a golden line.
// Coordinates: s from nose 0 to tail tip 1 and y up, in body lengths; v from belly -1 to back +1.
// Colours are linear Rec. 709 albedos.
#ifndef FISH_SKIN_GLSL
#define FISH_SKIN_GLSL

// CagePart of common/body/fish_body.h
const uint kCaudal = 1u, kFirstDorsal = 2u, kSecondDorsal = 3u, kAnal = 4u, kPelvic = 5u, kPectoral = 6u;

const vec3 kBack = vec3(0.010, 0.075, 0.150), kFlank = vec3(0.50, 0.60, 0.64);
const vec3 kBelly = vec3(0.74, 0.78, 0.79), kGold = vec3(0.66, 0.46, 0.050);
const vec3 kInk = vec3(0.006, 0.007, 0.009);

struct Skin {
    vec3 albedo;
    float silver;       // share of guanine mirror
    float iridescence;
    vec2 bump;          // tilt of the normal towards the tail and upwards
    float gloss;
};

float hash(uvec2 cell, uint salt) {
    uint h = cell.x * 374761393u + cell.y * 668265263u + salt * 974634541u;
    h = (h ^ (h >> 13)) * 1274126177u;
    return float((h ^ (h >> 16)) & 0xffffu) / 65535.0;
}
float noise(vec2 x, uint salt) {
    ivec2 cell = ivec2(floor(x));
    vec2 f = x - vec2(cell);
    f = f * f * (3.0 - 2.0 * f);
    return mix(mix(hash(uvec2(cell), salt), hash(uvec2(cell + ivec2(1, 0)), salt), f.x),
               mix(hash(uvec2(cell + ivec2(0, 1)), salt), hash(uvec2(cell + 1), salt), f.x), f.y);
}

// 1 on a line, fading over its width; a line thinner than a pixel grows fainter, not narrower.
float line(float x, float width, float pixel) {
    float wide = sqrt(width * width + 0.36 * pixel * pixel);
    float t = x / wide;
    return exp(-t * t) * width / wide;
}
// 1 within a distance of `at`, over a border no sharper than a pixel.
float within(float x, float at, float softness, float pixel) {
    float soft = max(softness, 0.7 * pixel);
    return 1.0 - smoothstep(at - soft, at + soft, x);
}

// What makes each fish its own: gold of the line, and a tint.
vec3 tintOf(uint id) {
    return 1.0 + 0.06 * (vec3(hash(uvec2(id, 1u), 7u), hash(uvec2(id, 2u), 7u), hash(uvec2(id, 3u), 7u)) - 0.5) * 2.0;
}
float goldOf(uint id) { return mix(0.75, 1.15, hash(uvec2(id, 4u), 7u)); }

// Blue-green back, silver flank, white belly and the golden line: all that one sees from afar.
vec3 ground(float s, float v, uint id, float ragged, float pixelV, out float stripe) {
    vec3 colour = mix(kBelly, kFlank, smoothstep(-0.75, -0.2, v));
    colour = mix(colour, kBack, smoothstep(0.30, 0.72, v + ragged));
    stripe = line(v - 0.34, 0.085, pixelV) * smoothstep(0.24, 0.30, s) * smoothstep(0.83, 0.74, s);
    return mix(colour, kGold * goldOf(id), 0.95 * stripe);
}
float silverOf(float s, float v, float stripe) {
    return 0.92 * smoothstep(0.62, 0.10, v) * smoothstep(0.015, 0.05, s) * (1.0 - 0.75 * stripe);
}
#endif
