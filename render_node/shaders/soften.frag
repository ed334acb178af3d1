// Forward scattering on the way to the eye: of the light of a thing at a range, a share arrives spread
// over some tenths of a degree. A tap is weighted by the share and spread of the water that both its
// light and the pixel's have crossed, that before the nearer of the two: so the distance softens behind
// a near fish, whose outline stays sharp, and blue water does not cover the fish. In: light of the scene, with its
// depth (resolve.frag). Out: linear light. Angles in radians; nearness is 1 over the range, 1/m.
#include "shader_interface.h"
#include "look_around.glsl"
#include "soften_taps.glsl"
layout(binding = kSceneUnit) uniform sampler2D scene;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 softened;

const float kGoldenAngle = 2.39996323;
const float kScatter = 0.028;  // 1/m
// Where the spread has become as wide as it gets.
const float kWidest = kScatterSigma * kScatterSigma / (kScatterMostSigma * kScatterMostSigma);

// Share of the light that is spread over a range r: 1 - exp(-a) with a = kScatter r^2 / (r + 8), as scattering near
// the thing moves its light by little. By Pade's a / (1 + a/2 + a^2/12): the same within 0.001 up to 45 m.
float shareSpread(float nearness) {
    float d = nearness + 8.0 * nearness * nearness;
    return kScatter * d / (d * d + 0.5 * kScatter * d + kScatter * kScatter / 12.0);
}

void main() {
    Neighbourhood here = neighbourhoodOf(uv);
    vec4 own = textureLod(scene, uv, 0.0);
    float nearness = nearnessOf(here.ahead, own.a);
    float share = shareSpread(nearness);
    float narrowness = max(nearness, kWidest);  // the spread's variance is kScatterSigma^2 over this
    float sigma = kScatterSigma * inversesqrt(narrowness);
    here.right *= 2.0 * sigma;
    here.up *= 2.0 * sigma;
    float weights = share;
    vec3 sum = own.rgb * weights;
    for (int i = 0; i < kTaps; ++i) {
        float area = (float(i) + 0.5) / float(kTaps);  // within the tap, of the disc of two sigma
        float turn = kGoldenAngle * float(i);
        vec3 place = beside(here, sqrt(area) * vec2(cos(turn), sin(turn)));
        vec4 tap = textureLod(scene, uvOf(place), 0.0);
        float nearer = max(nearnessOf(place, tap.a), nearness);
        float weight = shareSpread(nearer) * exp(-2.0 * area * max(nearer, kWidest) / narrowness);
        sum += weight * tap.rgb;
        weights += weight;
    }
    softened = vec4(mix(own.rgb, sum / weights, share), 1.0);
}
