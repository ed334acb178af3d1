// Near corals and plants, lit at each pixel. In: a SolidVertex and the chosen instance (grown.glsl).
// Out: world place, place without sway (rest), normal, albedo, occlusion, material.
#include "shader_interface.h"
const bool kStirs = true;
layout(location = kStirredLocation) uniform bool stirred;
#include "grown.glsl"
layout(location = 0) centroid out vec3 place;
layout(location = 1) centroid out vec3 rest;
layout(location = 2) centroid out vec4 normal;
layout(location = 3) centroid out vec3 albedo;
layout(location = 4) centroid out vec2 open;
layout(location = 5) centroid out vec3 matter;  // translucency, fluorescence, relief
void main() {
    Grown it = grown();
    place = it.place;
    rest = it.rest;
    normal = vec4(it.normal, normalAndRoughness.w);
    albedo = it.albedo;
    open = vec2(it.open.sun, it.open.sky);
    matter = response.yzw;
    gl_Position = clipFromWorld * vec4(place, 1.0);
}
