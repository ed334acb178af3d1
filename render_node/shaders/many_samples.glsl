// A picture with kSamples a pixel; see one_sample.glsl.
layout(binding = kSceneUnit) uniform sampler2DMS scene;
layout(binding = kDepthUnit) uniform sampler2DMS depth;

vec3 lightAt(ivec2 pixel) {
    vec3 sum = vec3(0.0);
    for (int i = 0; i < kSamples; ++i) sum += texelFetch(scene, pixel, i).rgb;
    return sum / float(kSamples);
}
float depthAt(ivec2 pixel) { return texelFetch(depth, pixel, 0).r; }
