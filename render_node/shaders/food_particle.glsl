// One particle of food, and numbers of its own.
// Places in world metres; unit() and axisOf() are functions of the seed alone.
#ifndef FOOD_PARTICLE_GLSL
#define FOOD_PARTICLE_GLSL
#include "shader_interface.h"
#include "hash.h"
struct Speck {
    vec3 place;
    uint seed;
};
layout(std430, binding = kSpecksStorage) readonly buffer Specks { Speck specks[]; };

// The n-th number of a seed, 0 to 1.
float unit(uint seed, uint n) { return unitOf(hashOf(seed * 16u + n)); }
vec3 axisOf(uint seed) {
    vec3 axis = vec3(unit(seed, 0u), unit(seed, 1u), unit(seed, 2u)) - 0.5;
    return normalize(axis + vec3(1.0e-3, 0.0, 0.0));
}
#endif
