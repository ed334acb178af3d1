// The sand. In: a SolidVertex and its CoarseVertex in world metres; how far the patch has faded into the
// coarser level. Out: world place and normal, clip space.
#include "frame_uniforms.h"
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 packedNormal;
layout(location = kCoarseAttribute) in vec3 coarsePosition;
layout(location = kCoarseAttribute + 1) in vec4 coarseNormal;
layout(location = kFadedLocation) uniform float faded;
layout(location = 0) out vec3 place;
layout(location = 1) out vec3 normal;
void main() {
    place = mix(position, coarsePosition, faded);
    normal = mix(packedNormal.xyz, coarseNormal.xyz, faded);
    gl_Position = clipFromWorld * vec4(place, 1.0);
}
