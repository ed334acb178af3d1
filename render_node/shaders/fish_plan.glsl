// What a view does with its lists: where each begins, which fish each turn of the surface buffer
// holds, and the commands that draw them. FishPlan of render_node/surface/fish_plan.h.
#ifndef FISH_PLAN_GLSL
#define FISH_PLAN_GLSL
#include "fish_lists.glsl"

const uint kMostSpecies = 64u;
const uint kTurns = 8u;     // of the surface buffer
const uint kSurfaces = 4u;  // levels that have one
const uint kTails = 11u;    // commands of a species that need no surface: see below

struct Command {  // as glDrawElementsIndirect takes it
    uint count, instances, firstIndex, firstVertex, firstInstance;
};
// Fish of one list that a turn holds: places in the school, and in the surface buffer.
struct Piece {
    uint firstFish, fish, firstVertex;
};
struct Turn {
    uint bodyGroups, bodyY, bodyZ;  // workgroups that evaluate it before bodies are drawn,
    uint finGroups, finY, finZ;     // and again before fins are, where another turn came between
    uint firstFish, padding;
};
layout(std430, binding = 6) buffer Plan {
    uint totals[kMostSpecies * kStride];  // fish, [species][level]
    uint firsts[kMostSpecies * kStride];  // the place of each list's first
    Turn turns[kTurns];
    Piece pieces[kTurns * kMostSpecies * kSurfaces];    // [turn][species][surface]
    Command bodies[kTurns * kMostSpecies * kSurfaces];  // the same
    Command fins[kTurns * kMostSpecies * kSurfaces];
    // [species]: bodies of few triangles, of its own list and of each surface's for which there was
    // no room; the same of fins; points.
    Command tails[kMostSpecies * kTails];
};
#endif
