// One pixel of the projector: the scene where it looks, times its share of the light, encoded.
// In: scene picture and projection map. Out: code of the projector, 0 to 1.
#include "shader_interface.h"
#include "project.glsl"
layout(binding = kSceneUnit) uniform sampler2D scene;           // linear light
layout(binding = kPlacesUnit) uniform sampler2D placeAndWeight;  // top row first

// Of a wall file, in linear light, a texel for each pixel.
layout(binding = kBlendUnit) uniform sampler2D fileBlend;
layout(binding = kBlackUnit) uniform sampler2D fileBlack;
layout(location = kMasksLocation) uniform bvec2 masks;  // which of them there are

void main() {
    ivec2 pixel = projectorPixel();
    vec3 light = projectedLight(scene, placeAndWeight, pixel);
    if (masks.x) light *= texelFetch(fileBlend, pixel, 0).rgb;
    if (masks.y) {
        vec3 black = texelFetch(fileBlack, pixel, 0).rgb;
        light = min(light, 1.0) * (1.0 - black) + black;
    }
    encoded = finished(light, pixel);
}
