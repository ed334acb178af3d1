// The surface from below: Snell's window where the slope lets light in, else the mirrored sea.
#include "water.glsl"
layout(binding = 13) uniform sampler2D waveTile;  // slopes, height
layout(location = 0) in vec3 place;
layout(location = 0) out vec4 radiance;
const float kIndex = 1.34;
const float kBrightening = 1.7956;  // index squared: a beam narrows as it enters the water

vec3 sky(vec3 direction) {
    vec2 across = sunAndFilterDepth.xz * kIndex;
    vec3 sun = vec3(across.x, sqrt(max(1.0 - dot(across, across), 0.05)), across.y);
    float away = dot(direction, sun) - 1.0;
    vec3 blue = mix(vec3(0.060, 0.076, 0.095), vec3(0.030, 0.050, 0.090),
                    smoothstep(0.0, 0.9, direction.y));
    return blue * daylight.yzw +
           daylight.x * vec3(1.0, 0.93, 0.82) * (2.2 * exp(260.0 * away) + 0.16 * exp(14.0 * away));
}

void main() {
    vec3 way = place - eyeAndTime.xyz;
    float range = length(way);
    vec3 w = way / range;
    // Waves, and the same pattern again as ripples on them.
    vec2 turned = vec2(0.83 * place.x - 0.56 * place.z, 0.56 * place.x + 0.83 * place.z);
    vec2 slope = 1.6 * texture(waveTile, place.xz / kTileMetres).xy +
                 1.7 * texture(waveTile, turned / 3.7).xy;
    // Steep facets would tear holes of sky into the mirror: waves break before.
    slope *= inversesqrt(1.0 + 8.0 * dot(slope, slope));
    vec3 normal = normalize(vec3(-slope.x, 1.0, -slope.y));
    float inward = max(dot(w, normal), 0.02);
    vec3 up = vec3(0.0);
    float mirror = 1.0;
    float sine2 = kIndex * kIndex * (1.0 - inward * inward);
    float outward = sqrt(max(1.0 - sine2, 0.0));
    if (sine2 < 1.0) {
        float s = (kIndex * inward - outward) / (kIndex * inward + outward);
        float p = (kIndex * outward - inward) / (kIndex * outward + inward);
        mirror = 0.5 * (s * s + p * p);
    }
    vec3 out_ = normalize(kIndex * w + (outward - kIndex * inward) * normal);
    up = sky(vec3(out_.x, max(out_.y, 0.02), out_.z)) * (kBrightening * (1.0 - mirror));
    vec3 down = reflect(w, -normal);
    down.y = -abs(down.y);
    // Water has coloured the mirrored light already: what `direct` will add is taken out.
    vec3 undone = exp(kdAndExposure.xyz * -sunAndFilterDepth.w);
    vec3 below = openWater(down, 0.4) * (0.9 * mirror) * undone;
    // As far as the open water behind it is seen (water.frag), or a line would show where it ends.
    radiance = vec4(direct(up + below, range, 0.0) + inscatter(w, min(range, 80.0)), 1.0);
}
