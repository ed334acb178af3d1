// Forward scattering on the way to the eye: of the light of a thing at a range, a share arrives spread
// over some tenths of a degree. A tap is weighted by the share and spread of the water that both its
// light and the pixel's have crossed, that before the nearer of the two: so the distance softens behind
// a near fish, whose outline stays sharp, and blue water does not cover the fish. In: picture and depth of the
// scene, one sample. Out: linear light. Angles in radians, ranges in metres.
#include "shader_interface.h"
#include "look_around.glsl"
#include "soften_taps.glsl"
layout(binding = kSceneUnit) uniform sampler2D scene;
layout(binding = kDepthUnit) uniform sampler2D depth;
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 softened;

const float kGoldenAngle = 2.39996323;

// Share of the light that is spread over a range, and the spread's sigma, radians. Scattering near the
// thing moves its light by little, so that the first metres count less.
float shareSpread(float range) { return 1.0 - exp(-0.028 * range * range / (range + 8.0)); }
float sigmaAt(float range) { return min(kScatterSigma * sqrt(range), kScatterMostSigma); }

void main() {
    Neighbourhood here = neighbourhoodOf(uv);
    vec3 own = textureLod(scene, uv, 0.0).rgb;
    float range = rangeOf(here.ahead, textureLod(depth, uv, 0.0).r);
    float share = shareSpread(range), sigma = sigmaAt(range);
    float weights = share;
    vec3 sum = own * weights;
    for (int i = 0; i < kTaps; ++i) {
        float away = 2.0 * sigma * sqrt((float(i) + 0.5) / float(kTaps));
        float turn = kGoldenAngle * float(i);
        vec3 tap = beside(here, away * vec2(cos(turn), sin(turn)));
        vec2 place = uvOf(tap);
        float tapRange = rangeOf(tap, textureLod(depth, place, 0.0).r);
        float nearer = min(tapRange, range);
        float x = away / sigmaAt(nearer);
        float weight = shareSpread(nearer) * exp(-0.5 * x * x);
        sum += weight * textureLod(scene, place, 0.0).rgb;
        weights += weight;
    }
    softened = vec4(mix(own, sum / weights, share), 1.0);
}
