// Where in its list each group begins: exclusive sums over a species' groups. One workgroup a list;
// each thread sums a run of groups.
// In: counts [group][list]. Out: the same buffer with exclusive sums, and totals of each list.
#include "shader_interface.h"
#include "fish_plan.glsl"

layout(local_size_x = kGroupSize) in;
layout(std430, binding = kCountsStorage) buffer Counts { uint counts[]; };  // [group][list]

shared uint sums[kGroupSize];

void main() {
    uint species = gl_WorkGroupID.x, list = gl_WorkGroupID.y, thread = gl_LocalInvocationID.x;
    uint end = kinds[species].firstGroup + kinds[species].groups;
    uint run = (kinds[species].groups + kGroupSize - 1u) / kGroupSize;
    uint first = kinds[species].firstGroup + thread * run;
    uint last = min(first + run, end);
    uint sum = 0u;
    for (uint group = first; group < last; ++group) sum += counts[group * kDetailStride + list];
    sums[thread] = sum;
    barrier();

    // Threads further on have no groups.
    uint busy = (kinds[species].groups + run - 1u) / max(run, 1u);
    uint before = 0u;
    for (uint other = 0u; other < min(thread, busy); ++other) before += sums[other];
    for (uint group = first; group < last; ++group) {
        uint count = counts[group * kDetailStride + list];
        counts[group * kDetailStride + list] = before;
        before += count;
    }
    if (thread == kGroupSize - 1u) totals[species * kDetailStride + list] = before;
}
