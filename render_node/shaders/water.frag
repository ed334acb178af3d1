// Open water, where nothing else is in view.
// In: uv of the picture. Out: scene radiance on the far plane.
#include "water.glsl"
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 radiance;
void main() {
    vec4 near = worldFromClip * vec4(uv * 2.0 - 1.0, 1.0, 1.0);
    radiance = vec4(inscatter(normalize(near.xyz / near.w - eyeAndTime.xyz), 80.0), 1.0);
}
