// The light that bright places spread about them: means over two rings of the picture's smaller copies, sized in
// radians. It has no detail, so that a picture of a quarter of the width will do. In: scene light with mip levels. Out:
// linear light.
#include "shader_interface.h"
#include "look_around.glsl"
layout(binding = kSceneUnit) uniform sampler2D scene;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 glow;

// Mean of eight taps on a ring of this radius (radians) and of its centre, from the mip level whose
// texels are about as wide.
vec3 ring(Neighbourhood here, float radius) {
    // Pixels in a radian there, whatever part of the picture is drawn.
    vec2 up = (here.up.xy - here.ahead.xy / here.ahead.z * here.up.z) / here.ahead.z;
    float pixels = 0.5 * length(viewport.xy * up);
    float lod = log2(max(0.7 * radius * pixels, 1.0));
    vec3 sum = textureLod(scene, uv, lod).rgb;
    for (int i = 0; i < 8; ++i) {
        float turn = 0.785398 * float(i);
        sum += textureLod(scene, uvOf(beside(here, radius * vec2(cos(turn), sin(turn)))), lod).rgb;
    }
    return sum / 9.0;
}

void main() {
    Neighbourhood here = neighbourhoodOf(uv);
    glow = vec4(0.5 * (ring(here, kBloomNear) + ring(here, kBloomFar)), 1.0);
}
