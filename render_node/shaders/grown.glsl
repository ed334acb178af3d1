// A vertex of a coral or plant: where the swell has carried it, and how it is lit. grown() reads the
// vertex attributes and the chosen instance, and returns place and normal in the world, albedo and
// occlusion. The shader that includes this says whether fish that pass may push: kStirs, and `stirred`.
#include "shader_interface.h"
#include "instance.glsl"
#include "plant_bend.h"
#include "shading.glsl"
#include "sea_now.glsl"
#include "wake.glsl"
layout(std430, binding = kWakeStorage) readonly buffer Wake { int wake[]; };
#include "solid_vertex.glsl"
layout(location = 3) in vec4 response;  // share of the sway, translucency, fluorescence, relief
layout(location = kReachLocation) uniform float reach;

// How far passing fish push a free plant, metres: interpolated between the middles of eight cells.
vec2 pushedAt(vec3 place) {
    vec3 at = place / kWakeCellMetres - 0.5;
    ivec3 low = ivec3(floor(at));
    vec3 share = at - vec3(low);
    vec2 sum = vec2(0.0);
    for (int corner = 0; corner < 8; ++corner) {
        ivec3 offset = ivec3(corner & 1, corner >> 1 & 1, corner >> 2);
        int index = wakeIndex(low + offset);
        if (index < 0) continue;
        vec3 weight = mix(1.0 - share, share, vec3(offset));
        sum += weight.x * weight.y * weight.z * vec2(wake[index], wake[index + 2]);
    }
    sum *= 0.5 * kWakeUnit;
    return 0.35 * sum / (0.35 + length(sum));  // a limit for any number of fish
}
// A plant leans by the way of the current in this time, as far as it sways.
const float kLeanSeconds = 6.0;
struct Grown {
    vec3 place, rest, normal, albedo;
    Occlusion open;
};
Grown grown() {
    Instance one = instanceOf(chosen);
    FadedVertex vertex = fadedVertex();
    // A thing shrinks before it is culled, so that it does not vanish suddenly.
    float shown = smoothstep(2.2, 4.5, reach * pixelsOf(one.placeAndScale));
    float scale = one.placeAndScale.w * shown;
    vec3 root = one.placeAndScale.xyz;
    Grown it;
    it.rest = root + scale * turned(one.turn, vertex.position);
    it.place = it.rest;
    float sway = one.tintAndSway.w;
    if (sway > 0.0) {
        float share = response.x;
        vec2 push = sway * scale * (surge(mix(root, it.rest, 0.7)) + kLeanSeconds * current.zw);
        if (kStirs && stirred) push += min(4.0 * sway, 1.0) * min(scale, 1.0) * pushedAt(it.rest);
        it.place += bentStem(share, scale, push) - vec3(0.0, scale * share, 0.0);
    }
    it.normal = turned(one.turn, vertex.normal);
    it.albedo = min(1.75 * vertex.albedoAndSky.rgb * one.tintAndSway.rgb, vec3(0.80));
    // A leaf has two sides: the one that faces the eye is lit.
    if (response.y > 0.3 && dot(it.normal, eyeAndTime.xyz - it.place) < 0.0) it.normal = -it.normal;
    // Sand close below takes some of the light from above.
    float contact = mix(0.55, 1.0, smoothstep(-0.05, 0.35, it.rest.y - one.sandHeightMetres));
    float own = vertex.albedoAndSky.w;
    it.open = Occlusion(one.occlusion.x * mix(0.35, 1.0, own), one.occlusion.y * own * contact);
    if (kFine) {
        Occlusion mapped = openAt(it.place, it.normal);
        it.open = Occlusion(min(it.open.sun, mapped.sun), min(it.open.sky, mapped.sky));
    }
    return it;
}
