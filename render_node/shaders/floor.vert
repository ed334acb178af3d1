// The sand, lit at each pixel. In: as floor_corner.glsl. Out: world place and normal, clip space.
#include "floor_corner.glsl"
layout(location = 0) out vec3 place;
layout(location = 1) out vec3 normal;
void main() {
    FloorCorner it = floorCorner();
    place = it.place;
    normal = it.normal;
    gl_Position = clipFromWorld * vec4(place, 1.0);
}
