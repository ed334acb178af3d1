// One particle of food, and numbers of its own.
#ifndef FOOD_PARTICLE_GLSL
#define FOOD_PARTICLE_GLSL
struct Speck {
    vec3 place;
    uint seed;
};
layout(std430, binding = 0) readonly buffer Specks { Speck specks[]; };

uint mixed(uint x) {
    x ^= x >> 16; x *= 0x7feb352du; x ^= x >> 15; x *= 0x846ca68bu; return x ^ (x >> 16);
}
// The n-th number of a seed, 0 to 1.
float unit(uint seed, uint n) { return float(mixed(seed * 16u + n) >> 8) / 16777216.0; }
vec3 axisOf(uint seed) {
    vec3 axis = vec3(unit(seed, 0u), unit(seed, 1u), unit(seed, 2u)) - 0.5;
    return normalize(axis + vec3(1.0e-3, 0.0, 0.0));
}
#endif
