// One pixel of a display that takes the pictures of two eyes at once.
// In: picture and map of both eyes. Out: code of the display, 0 to 1, laid out by `mode`.
#include "shader_interface.h"
#include "project.glsl"
layout(binding = kSceneUnit) uniform sampler2D leftScene;
layout(binding = kPlacesUnit) uniform sampler2D leftPlaces;
layout(binding = kRightSceneUnit) uniform sampler2D rightScene;
layout(binding = kRightPlacesUnit) uniform sampler2D rightPlaces;
layout(location = kModeLocation) uniform int mode;

// Red and cyan glasses by least squares over what display and filters do to the light (Dubois 2001),
// for linear light.
const mat3 kLeftToRed = mat3(0.4561, -0.0400822, -0.0152161,
                             0.500484, -0.0378246, -0.0205971,
                             0.176381, -0.0157589, -0.00546856);
const mat3 kRightToCyan = mat3(-0.0434706, 0.378476, -0.0721527,
                               -0.0879388, 0.73364, -0.112961,
                               -0.00155529, -0.0184503, 1.2264);

vec3 leftLight(ivec2 pixel) { return projectedLight(leftScene, leftPlaces, pixel); }
vec3 rightLight(ivec2 pixel) { return projectedLight(rightScene, rightPlaces, pixel); }
vec3 eyesLight(bool right, ivec2 pixel) {
    return masked(right ? rightLight(pixel) : leftLight(pixel), pixel);
}

// In a half picture each pixel is the mean of two pixels of the eye's picture, which has the full
// size.
vec3 pairOf(bool right, ivec2 first, ivec2 step) {
    return 0.5 * (eyesLight(right, first) + eyesLight(right, first + step));
}

void main() {
    ivec2 pixel = projectorPixel();
    ivec2 halves = size / 2;
    if (mode == kSideBySide) {
        bool right = pixel.x >= halves.x;
        ivec2 own = ivec2(pixel.x % halves.x, pixel.y);
        encoded = finished(pairOf(right, own * ivec2(2, 1), ivec2(1, 0)), own);
    } else if (mode == kTopBottom) {
        bool right = pixel.y >= halves.y;
        ivec2 own = ivec2(pixel.x, pixel.y % halves.y);
        encoded = finished(pairOf(right, own * ivec2(1, 2), ivec2(0, 1)), own);
    } else if (mode == kInterlaced) {
        encoded = finished(eyesLight(pixel.y % 2 == 1, pixel), pixel);
    } else {
        vec3 mixed = kLeftToRed * leftLight(pixel) + kRightToCyan * rightLight(pixel);
        encoded = finished(masked(max(mixed, 0.0), pixel), pixel);
    }
}
