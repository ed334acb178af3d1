// Replaces many_samples.glsl where a pixel has one.
layout(binding = kSceneUnit) uniform sampler2D scene;
layout(binding = kDepthUnit) uniform sampler2D depth;

vec3 lightAt(ivec2 pixel) { return texelFetch(scene, pixel, 0).rgb; }
float depthAt(ivec2 pixel) { return texelFetch(depth, pixel, 0).r; }
