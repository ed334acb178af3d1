// The plane of the surface, as far as the water lets one see.
// In: the vertex number, 0 to 3. Out: world place on a square of 600 m about the eye, clip space.
#include "frame_uniforms.h"
layout(location = 0) out vec3 place;
void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    place = vec3(eyeAndTime.x + 300.0 * corner.x, 0.0, eyeAndTime.z + 300.0 * corner.y);
    gl_Position = clipFromWorld * vec4(place, 1.0);
}
