// The light of the scene at a pixel, as it was drawn. bloom.glsl adds a glow.
#ifndef SCENE_LIGHT_GLSL
#define SCENE_LIGHT_GLSL
vec3 sceneLight(sampler2D scene, vec2 uv) { return textureLod(scene, uv, 0.0).rgb; }
#endif
