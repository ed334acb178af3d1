// Bloom: bright places glow a little, as in an eye and in a lens. Gives sceneLight(): linear light of
// the scene at uv (0 to 1, origin bottom left) with its glow, which glow.frag has made.
#ifndef BLOOM_GLSL
#define BLOOM_GLSL
#include "shader_interface.h"
layout(binding = kGlowUnit) uniform sampler2D glow;

// The share of the light that is spread.
const float kBloomShare = 0.012;

vec3 sceneLight(sampler2D scene, vec2 uv) {
    return mix(textureLod(scene, uv, 0.0).rgb, textureLod(glow, uv, 0.0).rgb, kBloomShare);
}
#endif
