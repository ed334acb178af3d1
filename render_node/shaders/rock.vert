// Rock: worn limestone, lit at each pixel.
// In: a SolidVertex and the chosen instance. Out: world place, normal, mottle, occlusion, tint; clip
// space.
#include "shader_interface.h"
layout(location = 0) centroid out vec3 place;
layout(location = 1) centroid out vec3 normal;
layout(location = 2) centroid out vec3 mottle;
layout(location = 3) centroid out vec2 open;
layout(location = 4) centroid out vec3 tint;
#include "rock_corner.glsl"
void main() {
    RockCorner it = rockCorner();
    place = it.place;
    normal = it.normal;
    mottle = it.mottle;
    open = it.open;
    tint = it.tint;
    gl_Position = clipFromWorld * vec4(place, 1.0);
}
