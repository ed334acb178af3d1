// A test pattern that lies on the screen, as a function of the direction from the wall's origin: the
// formulas of common/wall/pattern.h.
// In: uv, 0 to 1 over the frustum's picture. Out: linear light, 1 is full white. Directions in the
// wall's frame, angles in degrees.
#include "shader_interface.h"
layout(location = kWallFromCameraLocation) uniform mat3 wallFromCamera;
layout(location = kExtentsLocation) uniform vec4 extents;  // left, bottom, right, top: tangents
layout(location = kGreyLightLocation) uniform float greyLight;  // negative: the grid
layout(location = kGridLinesLocation) uniform vec4 gridLines;   // degrees between lines, between bright ones; light of the others; sigma, degrees
layout(location = kEyeAndRadiusLocation) uniform vec4 eyeAndRadius;  // wall frame; w: of the screen

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 light;

// A Gaussian about each multiple of `spacing`, degrees.
float lines(float at, float spacing) {
    float off = at - spacing * floor(at / spacing + 0.5);
    return exp(-off * off / (2.0 * gridLines.w * gridLines.w));
}

float majorAndMinor(float at) {
    return max(gridLines.z * lines(at, gridLines.x), lines(at, gridLines.y));
}

float gridLight(vec3 direction) {
    float azimuth = degrees(atan(direction.x, -direction.z));
    float elevation = degrees(atan(direction.y, length(direction.xz)));
    return max(majorAndMinor(azimuth), majorAndMinor(elevation));
}

// Where a ray from the eye, inside the cylinder, meets it.
vec3 onScreen(vec3 ray) {
    vec2 eye = eyeAndRadius.xz;
    float a = dot(ray.xz, ray.xz), b = dot(eye, ray.xz);
    float c = dot(eye, eye) - eyeAndRadius.w * eyeAndRadius.w;
    return eyeAndRadius.xyz + ray * ((sqrt(max(b * b - a * c, 0.0)) - b) / a);
}

void main() {
    vec3 ray = wallFromCamera * vec3(mix(extents.xy, extents.zw, uv), -1.0);
    vec3 direction = onScreen(ray);
    light = vec4(vec3(greyLight < 0.0 ? gridLight(direction) : greyLight), 1.0);
}
