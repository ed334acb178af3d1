// Bloom: bright places glow a little, as in an eye and in a lens. It takes means over two rings of the
// picture's smaller copies, sized in radians. Gives sceneLight(): linear light of the scene at uv (0 to
// 1, origin bottom left) with a glow. scene must have mip levels.
#ifndef BLOOM_GLSL
#define BLOOM_GLSL
#include "look_around.glsl"
#include "shader_interface.h"

// The share of the light that is spread.
const float kBloomShare = 0.012;

// Mean of eight taps on a ring of this radius (radians) and of its centre, from the mip level whose
// texels are about as wide.
vec3 ring(sampler2D scene, Neighbourhood here, vec2 uv, float radius) {
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

vec3 sceneLight(sampler2D scene, vec2 uv) {
    Neighbourhood here = neighbourhoodOf(uv);
    vec3 glow = 0.5 * (ring(scene, here, uv, kBloomNear) + ring(scene, here, uv, kBloomFar));
    return mix(textureLod(scene, uv, 0.0).rgb, glow, kBloomShare);
}
#endif
