// The light of the scene at a pixel, as it was drawn. bloom.glsl adds a glow.
// uv: 0 to 1, origin bottom left. The result is linear light.
#ifndef SCENE_LIGHT_GLSL
#define SCENE_LIGHT_GLSL
vec3 sceneLight(sampler2D scene, vec2 uv) { return textureLod(scene, uv, 0.0).rgb; }
#endif
