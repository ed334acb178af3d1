// Balls against the view's frustum, and the balls about groups of instances.
// World metres; the matrix of the view is that of the frame's uniform block.
#ifndef PLACE_GROUPS_GLSL
#define PLACE_GROUPS_GLSL
#include "shader_interface.h"
#include "frustum.glsl"
layout(std430, binding = kGroupsStorage) readonly buffer Groups { vec4 groupBalls[]; };
layout(location = kCullingLocation) uniform bool culling;

bool sees(vec3 centre, float reach) { return !culling || isInFrustum(centre, reach); }
#endif
