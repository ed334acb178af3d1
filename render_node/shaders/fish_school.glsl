// The fish that a view draws.
// Written by fish_scatter.comp; bound as storage kSchoolStorage.
#ifndef FISH_SCHOOL_GLSL
#define FISH_SCHOOL_GLSL
#include "shader_interface.h"
#include "fish_data.glsl"

layout(std430, binding = kSchoolStorage) readonly buffer School { Fish fish[]; };
#endif
