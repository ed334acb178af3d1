// Puts each fish that a view shows in its place, and unpacks the whole record of these fish alone. In:
// choices, sums, firsts, pieces, records, layers of drawings. Out: the drawn fish, in the order of the
// school within each list.
#include "shader_interface.h"
#include "fish_data.glsl"
#include "fish_record.glsl"
#include "fish_detail.glsl"
#include "fish_plan.glsl"
#include "drawn_layers.glsl"

layout(local_size_x = kGroupSize) in;
layout(std430, binding = kSchoolStorage) writeonly buffer School { Fish fish[]; };
layout(std430, binding = kChoicesStorage) readonly buffer Choices { uint choices[]; };  // list | rank << 4
layout(std430, binding = kCountsStorage) readonly buffer Counts { uint counts[]; };    // [group][list], sums
layout(location = kPageCountLocation) uniform uint pageCount;
layout(location = kFishCountLocation) uniform uint fishCount;

// The piece that contains its place, or none.
bool findSurface(uint species, uint surface, uint slot, out uint firstVertex) {
    Mesh mesh = kinds[species].meshes[1u + surface];
    for (uint p = 0u; p < pageCount; ++p) {
        Piece piece = pieceAt((p * kMostSpecies + species) * kSurfaces + surface);
        if (slot - piece.firstFish >= piece.fish) continue;
        firstVertex = piece.firstVertex + (slot - piece.firstFish) * mesh.vertexCount - mesh.firstVertex;
        return true;
    }
    return false;
}

void main() {
    uint species = 0u, group = gl_WorkGroupID.x;
    while (group >= kinds[species].firstGroup + kinds[species].groups) ++species;
    uint own = (group - kinds[species].firstGroup) * kGroupSize + gl_LocalInvocationID.x;
    uint i = kinds[species].firstFish + own;
    if (own >= kinds[species].fish || i >= fishCount) return;
    uint list = choices[i] & 15u;
    if (list == kUnseen) return;

    uint level = list % kDrawnLists;
    uint slot = firsts[species * kDetailStride + list] + counts[group * kDetailStride + list] + (choices[i] >> 4);
    Fish self;
    self.positionMetres = placeMetresOf(i);
    self.lengthMetres = lengthMetresOf(i);
    self.rotation = rotationOf(i);
    Motion motion = motionOf(i);
    self.phase = motion.phase;
    self.fromPhase = motion.fromPhase;
    self.warpWeight = motion.warpWeight;
    self.action = motion.action;
    self.fromAction = motion.fromAction;
    self.id = traits[i].x;
    self.species = species;
    uint detail = level;
    self.blend = detailAt(self.positionMetres, self.lengthMetres).blend;
    self.speed = speedOf(i);
    self.spread = spreadOf(i);
    self.gaze = gazeOf(i);
    self.mouth = mouthOf(i);
    self.firstVertex = 0u;
    if (level >= kControlMesh &&
        !findSurface(species, level - kControlMesh, slot, self.firstVertex)) {
        detail = kFewTriangles;
        self.blend = 1.0;
    }
    self.detailAndDrawing = detail | drawingOf(i, species) << 16;
    fish[slot] = self;
}
