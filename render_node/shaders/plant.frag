#include "light.glsl"
layout(location = 0) in vec3 place;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec3 colour;
layout(location = 3) in float open;
layout(location = 0) out vec4 radiance;
void main() {
    vec3 n = normalize(gl_FrontFacing ? normal : -normal);
    radiance = vec4(seen(litUnder(Openness(open, open), colour, place, n, 0.75), place), 1.0);
}
