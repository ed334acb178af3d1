// A test pattern that lies on the screen, as a function of the direction from its origin: the
// formulas of common/wall/pattern.h.
// In: uv, 0 to 1 over the frustum's picture. Out: linear light, 1 is full white. Directions in the
// wall's frame, angles in degrees.
#include "shader_interface.h"
layout(location = kWallFromCameraLocation) uniform mat3 wallFromCamera;
layout(location = kExtentsLocation) uniform vec4 extents;  // left, bottom, right, top: tangents
layout(location = kGreyLightLocation) uniform float greyLight;  // negative: the grid
// degrees between lines, between bright ones; light of the others; sigma, degrees
layout(location = kGridLinesLocation) uniform vec4 gridLines;
// As wall::PatternGround: the eye in its local frame, and w its size.
layout(location = kEyeAndSizeLocation) uniform vec4 eyeAndSize;
layout(location = kGroundLocation) uniform int ground;
layout(location = kLocalFromWallLocation) uniform mat3 localFromWall;

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 light;

// A Gaussian about each multiple of `spacing`, degrees; `scale`: of one of them, as an arc.
float lines(float at, float spacing, float scale) {
    float off = scale * (at - spacing * floor(at / spacing + 0.5));
    return exp(-off * off / (2.0 * gridLines.w * gridLines.w));
}

float majorAndMinor(float at, float scale) {
    return max(gridLines.z * lines(at, gridLines.x, scale), lines(at, gridLines.y, scale));
}

float gridLight(vec3 direction) {
    float azimuth = degrees(atan(direction.x, -direction.z));
    float elevation = degrees(atan(direction.y, length(direction.xz)));
    bool isAround = ground == kSphereGround || ground == kFarGround;
    float scale = isAround ? length(direction.xz) / length(direction) : 1.0;
    return max(majorAndMinor(azimuth, scale), majorAndMinor(elevation, 1.0));
}

// The distance along a ray from the eye to the ground, in lengths of the ray; the eye is inside the
// ground.
float wayToRound(float rayRay, float eyeRay, float eyeEye) {
    float c = eyeEye - eyeAndSize.w * eyeAndSize.w;
    return (sqrt(max(eyeRay * eyeRay - rayRay * c, 0.0)) - eyeRay) / rayRay;
}

// From the pattern's origin to where a ray of the wall's frame meets the ground.
vec3 onGround(vec3 ray) {
    vec3 eye = eyeAndSize.xyz, local = localFromWall * ray;
    if (ground == kFarGround) return ray;
    float way;
    if (ground == kSphereGround)
        way = wayToRound(dot(local, local), dot(eye, local), dot(eye, eye));
    else if (ground == kPlaneGround)
        way = (-eyeAndSize.w - eye.z) / local.z;
    else
        way = wayToRound(dot(local.xz, local.xz), dot(eye.xz, local.xz), dot(eye.xz, eye.xz));
    return (eye + local * way) * localFromWall;  // the transpose, applied
}

void main() {
    vec3 ray = wallFromCamera * vec3(mix(extents.xy, extents.zw, uv), -1.0);
    light = vec4(vec3(greyLight < 0.0 ? gridLight(onGround(ray)) : greyLight), 1.0);
}
