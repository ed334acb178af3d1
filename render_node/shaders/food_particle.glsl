// One particle of food, and numbers of its own.
// Places in world metres; unit() and axisOf() are functions of the seed alone.
#ifndef FOOD_PARTICLE_GLSL
#define FOOD_PARTICLE_GLSL
#include "shader_interface.h"
#include "frustum.glsl"
#include "hash.h"
struct Speck {
    vec3 place;
    uint seed;
};
layout(std430, binding = kSpecksStorage) readonly buffer Specks { Speck specks[]; };

// Of a particle as it is drawn, at most, metres: small ones are enlarged.
const float kMostReach = 0.05;
// What is not drawn is put beyond the picture.
const vec4 kOutside = vec4(2.0, 2.0, 2.0, 1.0);

// The n-th number of a seed, 0 to 1.
float unit(uint seed, uint n) { return unitOf(hashOf(seed * 16u + n)); }
vec3 axisOf(uint seed) {
    vec3 axis = vec3(unit(seed, 0u), unit(seed, 1u), unit(seed, 2u)) - 0.5;
    return normalize(axis + vec3(1.0e-3, 0.0, 0.0));
}
#endif
