// How much more or less than the mean the sun lights the water before 3, 8, 18 and 45 m along each
// direction. Never added light: a weighted mean of the caustics on the way.
#include "water.glsl"
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 upTo;

const float kGain = 2.3;
const int kSteps = 26;

vec3 directionOf(vec2 p) {
    // Beyond the edge the map goes on at the mirrored place: one texel of border for the filter.
    if (abs(p.x) > 1.0) p = vec2(sign(p.x) * 2.0 - p.x, -p.y);
    if (abs(p.y) > 1.0) p = vec2(-p.x, sign(p.y) * 2.0 - p.y);
    vec3 d = vec3(p.x, 1.0 - abs(p.x) - abs(p.y), p.y);
    if (d.y < 0.0)
        d.xz = (1.0 - abs(d.zx)) * vec2(d.x < 0.0 ? -1.0 : 1.0, d.z < 0.0 ? -1.0 : 1.0);
    return normalize(d);
}

void main() {
    vec3 direction = directionOf((uv * 2.0 - 1.0) * (kShaftTexels / (kShaftTexels - 2.0)));
    vec3 eye = eyeAndTime.xyz;
    vec4 sums = vec4(0.0), weights = vec4(1.0e-5);
    for (int i = 0; i < kSteps; ++i) {
        float x = (float(i) + 0.5) / float(kSteps);
        float range = 45.0 * x * x * (0.35 + 0.65 * x);
        float stride = 45.0 * (0.7 * x + 1.95 * x * x);
        vec3 place = eye + direction * range;
        float depth = -place.y;
        if (depth < 0.0) break;
        vec2 tile = (place.xz + sunAndFilterDepth.xz / sunAndFilterDepth.y * depth) / kTileMetres;
        float light = textureLod(causticTile, tile, 1.4 + 0.06 * range).r - 1.0;
        light = 1.0 + kGain * light * (1.0 - exp(-0.5 * depth)) * exp(-0.022 * depth);
        float weight = stride * exp(-0.075 * range);
        vec4 within = step(vec4(range), vec4(3.0, 8.0, 18.0, 45.0)) * weight;
        sums += within * max(light, 0.0);
        weights += within;
    }
    upTo = (sums + 1.0e-5) / weights;
}
