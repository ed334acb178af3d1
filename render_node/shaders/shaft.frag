// How much more or less than the mean the sun lights the water before 3, 8, 18 and 45 m along each
// direction. It adds no light: it is a weighted mean of the caustics on the way, without the light that
// rock and fish block. In: uv over the octahedral map of directions. Out: the four ratios, mean 1, one
// in each channel.
#include "shader_interface.h"
#include "water.glsl"
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 upTo;
layout(location = kTexelsLocation) uniform int texels;
layout(location = kStepsLocation) uniform int steps;

const float kGain = 2.2;

vec3 directionOf(vec2 p) {
    // Beyond the edge the map goes on at the mirrored place: one texel of border for the filter.
    if (abs(p.x) > 1.0) p = vec2(sign(p.x) * 2.0 - p.x, -p.y);
    if (abs(p.y) > 1.0) p = vec2(-p.x, sign(p.y) * 2.0 - p.y);
    vec3 d = vec3(p.x, 1.0 - abs(p.x) - abs(p.y), p.y);
    if (d.y < 0.0)
        d.xz = (1.0 - abs(d.zx)) * vec2(d.x < 0.0 ? -1.0 : 1.0, d.z < 0.0 ? -1.0 : 1.0);
    return normalize(d);
}

// The light at a place, relative to its mean there. apart: the distance on the surface between the
// sun's rays of one step and the next. The caustics are blurred by it; otherwise steps would appear as
// clouds. Towards the sun all rays pass the surface at one place, and shafts are sharp.
float lightAt(vec3 place, float range, float apart) {
    float depth = -place.y;
    float spread = 0.06 + range * (4.0 / float(texels)) + 0.35 * apart;
    float lod = log2(spread * (256.0 / kTileMetres));
    float gathered = net(surfacePoint(place), depth, lod) - 1.0;
    float light = max(1.0 + kGain * gathered * exp(-0.022 * depth), 0.0);
    if (!kFine) return light;
    vec2 fishUv = fishPlace(place);
    if (all(lessThan(abs(fishUv - 0.5), vec2(0.49)))) light *= pastFish(fishUv, place.y, 1.5);
    return light * sunPast(place);
}

void main() {
    vec3 direction = directionOf((uv * 2.0 - 1.0) * (float(texels) / float(texels - 2)));
    vec3 eye = eyeAndTime.xyz;
    float drift = length(surfacePoint(direction));
    vec4 sums = vec4(0.0), weights = vec4(1.0e-5);
    for (int i = 0; i < steps; ++i) {
        float x = (float(i) + 0.5) / float(steps);
        float range = 45.0 * x * x * (0.35 + 0.65 * x);
        float stride = 45.0 * (0.7 * x + 1.95 * x * x);
        vec3 place = eye + direction * range;
        if (place.y > 0.0) break;
        float weight = stride * exp(-0.075 * range);
        vec4 within = step(vec4(range), vec4(3.0, 8.0, 18.0, 45.0)) * weight;
        sums += within * lightAt(place, range, stride / float(steps) * drift);
        weights += within;
    }
    upTo = (sums + 1.0e-5) / weights;
}
