// The ground of the skin of the bigeye scad, Selar crumenophthalmus: a mirror with a golden line.
// Coordinates: s from nose 0 to tail tip 1 and y up, in body lengths; v from belly -1 to back +1.
// Colours are linear Rec. 709 albedos.
#ifndef FISH_SKIN_GLSL
#define FISH_SKIN_GLSL

const vec3 kBack = vec3(0.010, 0.075, 0.150), kFlank = vec3(0.50, 0.60, 0.64);
const vec3 kBelly = vec3(0.74, 0.78, 0.79), kGold = vec3(0.66, 0.46, 0.050);
const vec3 kIris = vec3(0.56, 0.53, 0.42);
const vec3 kInk = vec3(0.006, 0.007, 0.009);
const vec2 kEye = vec2(0.100, 0.016);
const float kEyeRadius = 0.036;

float hash(uvec2 cell, uint salt) {
    uint h = cell.x * 374761393u + cell.y * 668265263u + salt * 974634541u;
    h = (h ^ (h >> 13)) * 1274126177u;
    return float((h ^ (h >> 16)) & 0xffffu) * (1.0 / 65535.0);
}

// 1 below `from`, 0 above `to`.
float falling(float from, float to, float x) { return 1.0 - smoothstep(from, to, x); }

// 1 on a line, fading over its width. What is thinner than a pixel grows fainter, never shimmers.
float line(float x, float width, float pixel) {
    float wide = sqrt(width * width + 0.36 * pixel * pixel);
    float t = x / wide;
    return exp(-t * t) * width / wide;
}

// What makes each fish its own: a tint, and how golden its line is.
vec3 tintOf(uint id) {
    return 0.94 + 0.12 * vec3(hash(uvec2(id, 1u), 7u), hash(uvec2(id, 2u), 7u),
                              hash(uvec2(id, 3u), 7u));
}
float goldOf(uint id) { return mix(0.75, 1.20, hash(uvec2(id, 4u), 7u)); }

float goldenLine(float s, float v, float pixelV) {
    return line(v - 0.34, 0.085, pixelV) * smoothstep(0.24, 0.30, s) * falling(0.74, 0.83, s);
}

// Blue-green back, silver flank, white belly, golden line: all that one sees from afar. `ragged`
// lets single scales belong to the back or to the flank.
vec3 groundColour(float v, float ragged, float golden, uint id) {
    vec3 colour = mix(kBelly, kFlank, smoothstep(-0.75, -0.2, v));
    colour = mix(colour, kBack, smoothstep(0.30, 0.72, v + ragged));
    return mix(colour, kGold * goldOf(id), 0.95 * golden);
}

// Share of guanine mirror in the skin.
float silverOf(float s, float v, float golden) {
    return 0.88 * falling(0.10, 0.62, v) * smoothstep(0.015, 0.05, s) * (1.0 - 0.75 * golden);
}

// Stacks of guanine platelets hang upright whatever the curve of the skin (Denton 1970), so that a
// flank shows the level water around it: it vanishes, and flashes when the fish rolls.
vec3 plateletNormal(vec3 skinNormal, vec3 dorsal, vec3 toEye) {
    vec3 plate = skinNormal - 0.62 * dot(skinNormal, dorsal) * dorsal;
    float behind = min(dot(plate, toEye), 0.0);
    return normalize(plate - 2.0 * behind * toEye);
}

// What a mirror in the skin shows: the water, lifted a little towards the light, as scales lie like
// tiles; and other fish, who pass on some of the light from above.
vec3 reflected(vec3 mirrorNormal, vec3 fromEye, vec3 place) {
    vec3 shown = normalize(reflect(fromEye, mirrorNormal) + vec3(0.0, 0.34, 0.0));
    return mirrored(shown, place) + max(0.010 + 0.012 * mirrorNormal.y, 0.0);
}

// The floodlight is strong enough for the reef. What swims before it would be burnt white, so near
// fish take less of all light: their shading and their colours stay. White is what a white card
// that faces the eye would then send back.
struct FishLight {
    float eased;
    float white;
};
FishLight fishLight(vec3 place, vec3 fromEye) {
    float white = dot(lit(vec3(1.0), place, -fromEye, 0.0), vec3(0.2126, 0.7152, 0.0722));
    float eased = inversesqrt(1.0 + (white / 0.15) * (white / 0.15));
    return FishLight(eased, eased * white);
}

// A flank that faces the lamp gives its light back at once: the flash of a turning fish.
float flash(vec3 plate, vec3 fromEye) {
    float c = max(-dot(plate, fromEye), 0.0);
    c *= c; c *= c; c *= c;
    return 0.32 * c * c;
}

// Wet skin between the platelets. The rim of the outline shines most, and glints in the sun: less
// where it is narrower than a pixel.
vec3 sheenOf(vec3 shown, float gloss, float facing, float up, float pixel) {
    float resolved = clamp(0.003 / pixel, 0.0, 1.0);
    float grazing = (1.0 - facing) * (1.0 - facing) * resolved;
    float wet = gloss * (0.03 + 0.30 * grazing * grazing);
    return min(shown * (wet * (0.6 + 0.4 * up)), vec3(0.10 * resolved));
}

// Thin films colour the mirror faintly; more would be soap.
vec3 silverTint(float facing, vec3 albedo) {
    vec3 film = 0.88 + 0.09 * cos(6.2831853 * (vec3(0.0, 0.33, 0.67) + 1.35 * facing));
    return film * (0.60 + 0.80 * albedo);
}
#endif
