// Distant corals and plants, lit at their vertices, as a pixel holds several of them. In: as
// coral.vert. Out: the light that reaches the eye, linear Rec. 709, for lit.frag.
// They are too far away for a visible reaction to fish.
const bool kStirs = false, stirred = false;
#include "grown.glsl"
layout(location = 0) centroid out vec3 light;
void main() {
    Grown it = grown();
    vec3 own = litAt(1.0, it.open, it.albedo, it.place, normalize(it.normal), response.y) +
               fluorescent(it.albedo, response.z * albedoAndSky.w);
    light = seen(own, it.place);
    gl_Position = clipFromWorld * vec4(it.place, 1.0);
}
