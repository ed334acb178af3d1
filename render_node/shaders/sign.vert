// The box of a sign. In: four corners. Out: uv, 0 to 1 over the sign from its top left; clip space.
#include "shader_interface.h"
layout(location = kSignPlaceLocation) uniform vec4 place;  // left, bottom, right, top, 0 to 1 of the picture
layout(location = 0) out vec2 uv;

void main() {
    vec2 corner = vec2(gl_VertexID & 1, gl_VertexID >> 1);
    uv = vec2(corner.x, 1.0 - corner.y);
    gl_Position = vec4(mix(place.xy, place.zw, corner) * 2.0 - 1.0, 0.0, 1.0);
}
