// One pixel of the projector: the scene's light at its place, times its share of the light, encoded.
// In: scene picture and projection map. Out: code of the projector, 0 to 1.
#include "shader_interface.h"
#include "project.glsl"
layout(binding = kSceneUnit) uniform sampler2D scene;           // linear light
layout(binding = kPlacesUnit) uniform sampler2D placeAndWeight;  // top row first

void main() {
    ivec2 pixel = projectorPixel();
    encoded = finished(masked(projectedLight(scene, placeAndWeight, pixel), pixel), pixel);
}
