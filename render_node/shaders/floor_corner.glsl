// A corner of the sand: a SolidVertex and its CoarseVertex in world metres; how far the patch has faded into the
// coarser level. Out: world place and normal.
#include "frame_uniforms.h"
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 packedNormal;
layout(location = kCoarseAttribute) in vec3 coarsePosition;
layout(location = kCoarseAttribute + 1) in vec4 coarseNormal;
layout(location = kFadedAttribute) in float faded;
struct FloorCorner {
    vec3 place, normal;
};
FloorCorner floorCorner() {
    return FloorCorner(mix(position, coarsePosition, faded), mix(packedNormal.xyz, coarseNormal.xyz, faded));
}
