// The plane of the surface, as far as the water lets one see.
#include "frame_uniforms.h"
layout(location = 0) out vec3 place;
void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    place = vec3(eyeAndTime.x + 300.0 * corner.x, 0.0, eyeAndTime.z + 300.0 * corner.y);
    gl_Position = clipFromWorld * vec4(place, 1.0);
}
