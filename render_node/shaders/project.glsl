// Converts a projector pixel's light to its code. The dither is the same for both eyes; otherwise its
// grain would appear at a depth of its own. Pixels count from the top left corner. `light` is linear, 0
// to 1; `encoded` is what the projector takes: sRGB, or where its channel has a colour
// (formats::ChannelColour) what that says.
#include "shader_interface.h"
layout(location = kSizeLocation) uniform ivec2 size;  // of the projector's picture
layout(location = kSeedLocation) uniform uint seed;
layout(location = kDitheredLocation) uniform bool dithered;
layout(location = kBlendMaskLocation) uniform bool blendMask;
layout(location = kBrightnessLocation) uniform float brightness;  // share of the light, 0 black

// Blend and black level of a wall file, in linear light, with a texel for each pixel of the display,
// for either eye.
layout(binding = kBlendUnit) uniform sampler2D fileBlend;
layout(binding = kBlackUnit) uniform sampler2D fileBlack;
layout(location = kMasksLocation) uniform bvec2 masks;  // which of the two exist
layout(location = kColouredLocation) uniform bool coloured;
layout(location = kMixLocation) uniform mat3 ownFromLight;  // to the projector's red green blue
layout(binding = kCodesUnit) uniform sampler1D codes;       // for each of them

layout(location = 0) out vec4 encoded;

// sRGB (IEC 61966-2-1), the curve of the projector that undoes it.
vec3 encode(vec3 linear) {
    vec3 curve = 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055;
    return mix(curve, 12.92 * linear, lessThanEqual(linear, vec3(0.0031308)));
}

// Linear between texels, in full floats.
float codeOf(float own, int colour) {
    float place = sqrt(own) * float(kCodeTexels - 1);
    int low = min(int(place), kCodeTexels - 2);
    return mix(texelFetch(codes, low, 0)[colour], texelFetch(codes, low + 1, 0)[colour], place - float(low));
}

vec3 ownCodes(vec3 light) {
    vec3 own = clamp(ownFromLight * light, 0.0, 1.0);
    return vec3(codeOf(own.r, 0), codeOf(own.g, 1), codeOf(own.b, 2));
}

// Three independent numbers of 32 bits (pcg3d: Jarzynski and Olano 2020).
uvec3 noise(uvec3 v) {
    v = v * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> 16u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    return v;
}

// Rounds to one of 256 codes, exact in the mean. Triangular noise of +-1 code has the same grain at
// every level. Within half a code of either end it would be cut off and shift the mean. There uniform
// noise takes its place, whose grain is the same at that point and fades to none at the end.
vec3 toCodes(vec3 value, uvec3 random) {
    vec3 code = value * 255.0;
    vec3 first = vec3(random & 0xffffu) / 65536.0;
    vec3 second = vec3(random >> 16u) / 65536.0;
    bvec3 atAnEnd = greaterThan(abs(code - 127.5), vec3(127.0));
    return floor(code + mix(first + second - 0.5, first, atAnEnd)) / 255.0;
}

// The fragment's pixel, from the top left corner.
ivec2 projectorPixel() { return ivec2(gl_FragCoord.x, size.y - 1 - int(gl_FragCoord.y)); }

// The light of the scene at a texel of the map, top row first.
vec3 projectedLight(sampler2D scene, sampler2D placeAndWeight, ivec2 pixel) {
    vec3 place = texelFetch(placeAndWeight, pixel, 0).xyz;
    return (blendMask ? vec3(1.0) : textureLod(scene, place.xy, 0.0).rgb) * place.z;
}

vec3 masked(vec3 light, ivec2 pixel) {
    if (masks.x) light *= texelFetch(fileBlend, pixel, 0).rgb;
    if (!masks.y) return light;
    vec3 black = texelFetch(fileBlack, pixel, 0).rgb;
    return min(light, 1.0) * (1.0 - black) + black;
}

vec4 finished(vec3 light, ivec2 pixel) {
    vec3 shown = clamp(light * brightness, 0.0, 1.0);
    vec3 value = coloured ? ownCodes(shown) : encode(shown);
    if (dithered) value = toCodes(value, noise(uvec3(pixel, seed)));
    return vec4(value, 1.0);
}
