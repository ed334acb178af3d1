// Selects the instances that a view may show, and their level of detail: each one is added to the draw
// of its prototype at that level. A ball against the four sides of the frustum; the level follows from
// the angle at the shared eye in units of the wall's finest pixel, so that neighbours agree. In: seen
// groups, instances, prototypes. Out: instance counts of the commands, and the list of chosen
// instances, with how far each has faded into the next level. The order within a command is not fixed;
// opaque draws do not depend on it.
#include "shader_interface.h"
#include "draw_command.glsl"
#include "instance.glsl"
#include "place_groups.glsl"
layout(local_size_x = kGroupSize) in;
struct Prototype {
    float reach, middle;
    uint firstCommand, commandStride;
    float leastPixels[5];
};
layout(std430, binding = kPrototypesStorage) readonly buffer Prototypes { Prototype prototypes[]; };
layout(std430, binding = kCommandsStorage) buffer Commands { Command commands[]; };
layout(std430, binding = kChosenStorage) writeonly buffer Chosen { uint chosenOnes[]; };
layout(std430, binding = kSeenGroupsStorage) readonly buffer SeenGroups {
    uint groupsX, groupsY, groupsZ, seenGroups[];
};
layout(location = kInstanceCountLocation) uniform uint instanceCount;
layout(location = kCullDetailLocation) uniform float detail;

void main() {
    uint id = seenGroups[gl_WorkGroupID.x] * gl_WorkGroupSize.x + gl_LocalInvocationID.x;
    if (id >= instanceCount) return;
    Instance one = instances[id];
    Prototype prototype = prototypes[one.prototype];
    float scale = one.placeAndScale.w;
    vec3 centre = one.placeAndScale.xyz + turned(one.turn, vec3(0.0, prototype.middle * scale, 0.0));
    // Plants that bend reach further.
    float reach = scale * (prototype.reach + 1.5 * one.tintAndSway.w);
    if (!sees(centre, reach)) return;
    float pixels = detail * pixelsOf(one.placeAndScale);
    uint level = 0u;
    while (level < 5u && pixels < prototype.leastPixels[level]) ++level;
    if (level == 5u) return;
    float least = prototype.leastPixels[level];
    uint command = prototype.firstCommand + level * prototype.commandStride;
    uint slot = commands[command].baseInstance + atomicAdd(commands[command].instanceCount, 1u);
    chosenOnes[slot] = packedChoice(id, 1.0 - smoothstep(least, kFade * least, pixels));
}
