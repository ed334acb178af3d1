// The inputs and outputs of skin shaders, and the functions that they share. A species' file,
// skin_NAME.glsl, has a function each for the ground of its pattern, for what is seen only from near,
// and for its fins. Coordinates: s from nose 0 to tail tip 1, y up and z to the right, in body lengths;
// v from belly -1 to back +1. Colours are linear Rec. 709 albedos.
#ifndef SKIN_GLSL
#define SKIN_GLSL
#include "shader_interface.h"

const vec3 kInk = vec3(0.006, 0.007, 0.009);

uniform vec3 eyeOfSpecies;  // s, y and radius, body lengths
// Of the species' file, body lengths: the gape's front and corner (s, y); width of a lip, and teeth
// (config::Teeth); station and bow of the gill cover's hind edge.
uniform vec4 gapeOfSpecies;
uniform vec2 lipsOfSpecies;
uniform vec2 gillOfSpecies;
uniform vec3 groundColours[3];  // back, flank, belly of the species' file

struct SkinPoint {
    float s, y, z, v;
    float pixel;   // what a pixel covers, body lengths
    float pixelV;  // and in v
    uint id;       // of the fish
    float size;    // of the fish, from nose to tail tip, metres
    float mouth;   // from the skin (0) over the lips (kLips) to the inside of the mouth (1)
    float lips;    // how far outside of the lips, body lengths
    float gill;    // how far the gill cover is lifted, 0 to 1
};
const float kLips = 0.5;

struct Skin {
    vec3 albedo;
    float silver;       // share of guanine mirror
    float iridescence;  // how much thin films colour the albedo
    float gloss;        // of the wet surface
    float soft;         // how far light spreads within: 0 leather, 1 jelly
    vec2 tilt;          // of the normal, towards the tail and upwards
    vec2 flicker;       // of the platelets, scale by scale
};
Skin skinOf(vec3 albedo, float gloss, float soft) {
    return Skin(albedo, 0.0, 0.0, gloss, soft, vec2(0.0), vec2(0.0));
}

struct FinPoint {
    uint part;
    float p, q;   // along its base, and from base to edge
    float under;  // 1 on the side that looks down, 0 on the other
    SkinPoint at;
};

struct Fin {
    vec3 albedo;
    float opacity;
    float rays;     // from front to rear; 0: fleshy, of one piece
    float spined;   // the p before which rays are spines, which never fork
    float ribbing;  // how much rays stand out
};

// The parameters of a painted eye.
struct Iris {
    vec3 colour;
    vec3 ring;      // about the pupil
    float pupil;    // radius, of the eye's
    float upright;  // how much higher than wide the pupil is
};

float hash(uvec2 cell, uint salt) {
    uint h = cell.x * 374761393u + cell.y * 668265263u + salt * 974634541u;
    h = (h ^ (h >> 13)) * 1274126177u;
    return float((h ^ (h >> 16)) & 0xffffu) * (1.0 / 65535.0);
}

// 1 below `from`, 0 above `to`.
float falling(float from, float to, float x) { return 1.0 - smoothstep(from, to, x); }

float bell(float x, float middle, float width) {
    float t = (x - middle) / width;
    return exp(-t * t);
}

// 1 where |x| < halfWidth, softly.
float band(float x, float halfWidth, float soft) {
    return falling(halfWidth - soft, halfWidth + soft, abs(x));
}

// 1 on a line, fading over its width. A line that is thinner than a pixel becomes fainter and does not
// shimmer.
float line(float x, float width, float pixel) {
    float wide = sqrt(width * width + 0.36 * pixel * pixel);
    float t = x / wide;
    return exp(-t * t) * width / wide;
}

// The softness of a painted edge, at least a pixel.
float edgeOf(SkinPoint at) { return 0.7 * at.pixel + 0.0018; }

// 1 where details of this size are well seen, 0 where they are too fine for the pixel.
float seenAt(float size, float pixel) { return clamp(0.45 * size / pixel - 0.9, 0.0, 1.0); }

// A fish's own number, 0 .. 1, and one between two bounds.
float own(uint id, uint what) { return hash(uvec2(id, what), 7u); }
float ownBetween(uint id, uint what, float least, float most) {
    return mix(least, most, own(id, what));
}
// The tint of this fish, +-3.5 % a channel.
vec3 tintOf(uint id) { return 0.965 + 0.07 * vec3(own(id, 1u), own(id, 2u), own(id, 3u)); }

// Smooth noise, 0 .. 1, mean 0.5.
float noise(vec2 x) {
    uvec2 cell = uvec2(ivec2(floor(x)) + 4096);
    vec2 t = smoothstep(0.0, 1.0, fract(x));
    float below = mix(hash(cell, 3u), hash(cell + uvec2(1u, 0u), 3u), t.x);
    float above = mix(hash(cell + uvec2(0u, 1u), 3u), hash(cell + uvec2(1u, 1u), 3u), t.x);
    return mix(below, above, t.y);
}

// The grain of a skin, of cells this wide: noise that gives way to its mean where a pixel covers
// a cell.
float grain(SkinPoint at, float size) {
    float seen_ = seenAt(2.0 * size, at.pixel);
    if (seen_ <= 0.0) return 0.5;
    float side = at.z < 0.0 ? 57.0 : 0.0;
    return mix(0.5, noise(vec2(at.s, at.y) / size + side), seen_);
}

// Height along the skin: over the back and the belly it follows the curve inwards, where y hardly
// changes. thickness: half of the body's greatest.
float girthOf(SkinPoint at, float thickness) {
    float half_ = thickness * smoothstep(-0.05, 0.25, at.s) * (1.0 - 0.85 * smoothstep(0.4, 0.85, at.s));
    return at.y + sign(at.y) * max(half_ - abs(at.z), 0.0) * smoothstep(0.45, 0.85, abs(at.v));
}

struct Scale {
    float rim;  // 0 in the middle .. 1 at the free edge
    vec2 slope;
    vec2 own;  // two numbers of its own, 0 .. 1
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
            float number = hash(cell, 0u);
            vec2 centre = vec2((i + shift + 0.44 + 0.12 * number) * size, (j + 0.5) * 0.5 * size);
            vec2 from = (at - centre) / (size * vec2(0.78, 0.62));
            float r = length(from);
            if (r < 1.0 && centre.x < nearest) {
                nearest = centre.x;
                scale = Scale(r, from, vec2(number, fract(number * 61.0)));
            }
        }
    }
    return scale;
}

// Lays scales over a skin: each has its own shade, is tilted like a tile and darker at its edge. on:
// where they are, 0 .. 1. Returns values from which a skin shader may colour them.
Scale layScales(inout Skin skin, SkinPoint at, float thickness, float size, float relief, float on) {
    float detail = seenAt(size, at.pixel) * on;
    Scale scale = scaleAt(vec2(at.s, girthOf(at, thickness)), size, detail > 0.0);
    float edge = smoothstep(0.74, 1.0, scale.rim);
    skin.albedo *= 1.0 + detail * (0.22 * (scale.own.x - 0.5) - 0.20 * edge);
    skin.tilt += detail * relief * scale.slope;
    skin.flicker += detail * (scale.own - 0.5);
    return scale;
}

// The plain ground of most fish: dark above, pale below (counter-shading), with soft borders.
vec3 shadedGround(float v, vec3 back, vec3 flank, vec3 belly) {
    vec3 colour = mix(belly, flank, smoothstep(-0.80, -0.25, v));
    return mix(colour, back, smoothstep(0.35, 0.85, v));
}
#endif
