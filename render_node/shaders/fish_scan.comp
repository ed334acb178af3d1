// Where in its list each group begins: exclusive sums over a species' groups. One workgroup a list;
// each thread sums a run of groups.
#include "fish_plan.glsl"

const uint kThreads = 64u;
layout(local_size_x = 64) in;
layout(std430, binding = 7) buffer Counts { uint counts[]; };  // [group][level]

shared uint sums[kThreads];

void main() {
    uint species = gl_WorkGroupID.x, level = gl_WorkGroupID.y, thread = gl_LocalInvocationID.x;
    uint end = kinds[species].firstGroup + kinds[species].groups;
    uint run = (kinds[species].groups + kThreads - 1u) / kThreads;
    uint first = kinds[species].firstGroup + thread * run;
    uint last = min(first + run, end);
    uint sum = 0u;
    for (uint group = first; group < last; ++group) sum += counts[group * kStride + level];
    sums[thread] = sum;
    barrier();

    uint before = 0u;
    for (uint other = 0u; other < thread; ++other) before += sums[other];
    for (uint group = first; group < last; ++group) {
        uint count = counts[group * kStride + level];
        counts[group * kStride + level] = before;
        before += count;
    }
    if (thread == kThreads - 1u) totals[species * kStride + level] = before;
}
