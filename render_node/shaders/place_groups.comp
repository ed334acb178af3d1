// Which groups of instances a view may show: a ball about each against the frustum. Only their
// instances are then culled one by one (place_cull.comp), so that groups behind the eye cost next to
// nothing. In: balls of groups, world metres. Out: the list of seen groups, and its length as a
// dispatch.
#include "shader_interface.h"
#include "place_groups.glsl"
layout(local_size_x = kGroupSize) in;
layout(std430, binding = kSeenGroupsStorage) buffer SeenGroups { uint groupsX, groupsY, groupsZ, seenGroups[]; };
layout(location = kGroupCountLocation) uniform uint groupCount;

void main() {
    uint id = gl_GlobalInvocationID.x;
    if (id >= groupCount) return;
    vec4 ball = groupBalls[id];
    if (sees(ball.xyz, ball.w)) seenGroups[atomicAdd(groupsX, 1u)] = id;
}
