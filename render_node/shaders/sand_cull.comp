// Selects the patches of sand that a view may show, their level of detail, and how far it has faded into the next: one
// thread a patch, which has one command. In: balls about the patches, world metres; the draw of each patch at each
// level. Out: the commands, and how far each patch has faded.
#include "shader_interface.h"
#include "draw_command.glsl"
#include "place_groups.glsl"
layout(local_size_x = kGroupSize) in;
layout(std430, binding = kPatchLevelsStorage) readonly buffer PatchLevels { Command patchLevels[]; };
layout(std430, binding = kCommandsStorage) writeonly buffer Commands { Command commands[]; };
layout(std430, binding = kFadedStorage) writeonly buffer Faded { float faded[]; };
layout(location = kGroupCountLocation) uniform uint patchCount;
// Distances are divided by it.
layout(location = kPatchReachLocation) uniform float reach;
layout(location = kPatchEyeLocation) uniform vec3 eye;

void main() {
    uint id = gl_GlobalInvocationID.x;
    if (id >= patchCount) return;
    vec4 ball = groupBalls[id];
    float range = distance(ball.xyz, eye) / reach;
    uint level = uint(range >= kSandMiddleMetres) + uint(range >= kSandCoarseMetres);
    float end = level == 0u ? kSandMiddleMetres : kSandCoarseMetres;
    faded[id] = level + 1u == kSandLevels ? 0.0 : smoothstep(end / kFade, end, range);
    Command command = patchLevels[kSandLevels * id + level];
    command.instanceCount = sees(ball.xyz, ball.w) ? 1u : 0u;
    commands[id] = command;
}
