// The sand. In: a SolidVertex in world metres. Out: world place and normal, clip space.
#include "frame_uniforms.h"
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 packedNormal;
layout(location = 0) out vec3 place;
layout(location = 1) out vec3 normal;
void main() {
    place = position;
    normal = packedNormal.xyz;
    gl_Position = clipFromWorld * vec4(position, 1.0);
}
