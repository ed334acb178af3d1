// The fish that a view draws.
#ifndef FISH_SCHOOL_GLSL
#define FISH_SCHOOL_GLSL
#include "fish_data.glsl"

layout(std430, binding = 0) readonly buffer School { Fish fish[]; };
#endif
