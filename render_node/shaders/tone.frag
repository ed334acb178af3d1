// Converts the light of the scene to the light of the display, both linear. It is the same everywhere
// on the wall and at all times; with a histogram neighbours would differ. In: linear scene light. Out:
// linear display light, 0 black to 1 full white.
#include "shader_interface.h"
#include "frame_uniforms.h"
#include "scene_light.glsl"
layout(binding = kSceneUnit) uniform sampler2D scene;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 display;
// A filter before the lens: luminance stays. Magenta, as divers have for green water; the more colour
// is given back, the less of it is needed, and then a warm one.
const vec3 kFilter = vec3(1.15, 0.96, 1.07), kGradedFilter = vec3(1.0875, 0.99125, 0.945);
const float kSaturation = 1.08;

// Water is bluer than the display can show (red below 0): a soft floor at 4.5 % of the brightest
// channel, which keeps the ratio of green to blue.
vec3 intoGamut(vec3 c) {
    float top = max(c.r, max(c.g, c.b));
    vec3 above = c - 0.045 * top;
    float knee = 0.075 * top + 1.0e-6;
    return 0.045 * top + 0.5 * (above + sqrt(above * above + knee * knee));
}

// x^a / (b x^a + c) through .18 -> .19 and 9 -> 1: a toe that keeps 2.5 stops of blue above a
// projector's black, a shoulder of 4 stops.
vec3 curve(vec3 x) {
    vec3 power = pow(max(x, 0.0), vec3(1.46));
    return power / (0.9859 * power + 0.3499);
}

void main() {
    vec3 c = intoGamut(sceneLight(scene, uv)) * kdAndExposure.w;
    c *= mix(kFilter, kGradedFilter, grading.x);
    c = mix(vec3(dot(c, vec3(0.2126, 0.7152, 0.0722))), c, kSaturation);
    // Bright blue goes to white through its neighbours, not to a flat cyan.
    c = mat3(0.86, 0.07, 0.07, 0.07, 0.86, 0.07, 0.06, 0.06, 0.88) * c;
    c = curve(c);
    c = mat3(1.130, -0.065, -0.065, -0.065, 1.130, -0.065, -0.055, -0.055, 1.110) * c;
    display = vec4(clamp(c, 0.0, 1.0), 1.0);
}
