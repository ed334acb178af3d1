// Which fish a view shows, and how finely: one thread a fish, one workgroup a group. Only place and
// length are unpacked here; the rest of an unseen fish is never read (paper, section 4.3). In: records,
// cast, limits, planes, layers of drawings. Out: choices (list and rank of each fish), counts of each group and list.
#include "shader_interface.h"
#include "fish_record.glsl"
#include "fish_detail.glsl"
#include "fish_lists.glsl"
#include "drawn_layers.glsl"

layout(local_size_x = kGroupSize) in;
layout(std430, binding = kChoicesStorage) writeonly buffer Choices { uint choices[]; };  // list | rank << 4
layout(std430, binding = kCountsStorage) writeonly buffer Counts { uint counts[]; };    // [group][list]
layout(location = kFishCountLocation) uniform uint fishCount;

// The fish of the group in each list, one bit each, so that the order of arrival does not matter.
shared uint members[kDetailStride][2];

// The list of the species, as a level of detail, and kDrawnLists further where it wears a drawing.
uint listOf(Species species, uint s, uint i) {
    if (isAway(i)) return kUnseen;
    vec3 place = placeMetresOf(i);
    float lengthMetres = lengthMetresOf(i);
    // The radius of all that is drawn of the fish; a point may be wider than the fish.
    float margin = species.area.w * lengthMetres + 3.0 * sharedEye.w * distance(sharedEye.xyz, place);
    if (culls && !reaches(place, margin)) return kUnseen;
    return detailAt(place, lengthMetres).level + (drawingOf(i, s) > 0u ? kDrawnLists : 0u);
}

void main() {
    uint lane = gl_LocalInvocationID.x, group = gl_WorkGroupID.x;
    if (lane < kDetailStride) members[lane][0] = members[lane][1] = 0u;
    barrier();

    uint s = 0u;
    while (group >= kinds[s].firstGroup + kinds[s].groups) ++s;
    uint own = (group - kinds[s].firstGroup) * kGroupSize + lane;
    uint i = kinds[s].firstFish + own;
    uint list = own < kinds[s].fish && i < fishCount ? listOf(kinds[s], s, i) : kUnseen;
    if (list != kUnseen) atomicOr(members[list][lane >> 5], 1u << (lane & 31u));
    barrier();

    if (list != kUnseen) {
        uint below = bitCount(members[list][lane >> 5] & ((1u << (lane & 31u)) - 1u));
        uint rank = below + (lane < 32u ? 0u : bitCount(members[list][0]));
        choices[i] = list | rank << 4;
    } else if (own < kinds[s].fish) {
        choices[i] = kUnseen;
    }
    if (lane < kDetailStride)
        counts[group * kDetailStride + lane] = bitCount(members[lane][0]) + bitCount(members[lane][1]);
}
