// A test pattern of the world as a function of the direction from the sweet spot: the formulas of
// common/wall/pattern.h.
layout(location = 0) uniform mat3 wallFromCamera;
layout(location = 3) uniform vec4 extents;  // left, bottom, right, top: tangents
layout(location = 4) uniform float greyLight;  // negative: the grid
layout(location = 5) uniform vec4 gridLines;   // degrees between lines, between bright ones; light of the others; sigma, degrees

layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 light;

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

void main() {
    vec3 direction = wallFromCamera * vec3(mix(extents.xy, extents.zw, uv), -1.0);
    light = vec4(vec3(greyLight < 0.0 ? gridLight(direction) : greyLight), 1.0);
}
