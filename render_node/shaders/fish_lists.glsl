// The lists into which kernels sort the fish: a list is a species at a level of detail, in its own skin
// or in drawings. Fish are counted in groups that no two species share, so that each finds its place
// without waiting for any other, and the order is always that of the school.
#ifndef FISH_LISTS_GLSL
#define FISH_LISTS_GLSL
#include "shader_interface.h"


struct Mesh {
    uint vertexCount;
    uint firstEntry;   // in the stencils' offsets
    uint firstParent;  // in the parents
    uint firstVertex, bodyIndices, firstBodyIndex, finIndices, firstFinIndex;
};
struct Species {
    uint firstFish, fish, firstGroup, groups;
    vec4 area;    // seen from the front, from above, from the side: square body lengths; w: reach
    vec4 middle;  // of the body, in its frame, body lengths
    Mesh meshes[kMeshes];
};
layout(std430, binding = kCastStorage) readonly buffer Cast { Species kinds[]; };
#endif
