// The shadows of a place: of the sea floor with all that stands on it, and of the fish. Every map is
// indexed by where a straight ray from the place meets the surface, and holds heights, so that a shadow
// is softer the higher its thrower is above it. In: world metres. Out: shares of light, 0 to 1.
#ifndef SHADOW_GLSL
#define SHADOW_GLSL
#include "shader_interface.h"
#include "frame_uniforms.h"
#include "sea_now.glsl"

layout(binding = kSunHeightsUnit) uniform sampler2D sunHeights;  // topmost height along the sun's ray, and its square
layout(binding = kTopHeightsUnit) uniform sampler2D topHeights;  // the same straight from above
// optical depth along the sun's ray; times height; times its square
layout(binding = kFishOnTheWayUnit) uniform sampler2D fishOnTheWay;

// How much of the sun and of the light from above reaches a place (1: nothing stands in the way).
struct Occlusion {
    float sun;
    float sky;
};

// Where the straight ray of the sun through a place meets the surface: world x and z.
vec2 surfacePoint(vec3 place) {
    return place.xz - sunAndFilterDepth.xz / sunAndFilterDepth.y * place.y;
}

// The share of the map's heights here that are not above a height: Chebyshev's bound (Donnelly and
// Lauritzen 2006), less its tail, which would let light bleed in.
float shareNotAbove(vec2 moments, float height) {
    float above = moments.x - height;
    float variance = max(moments.y - moments.x * moments.x, 0.0) + 0.0015;
    float bound = variance / (variance + above * above);
    return above <= 0.0 ? 1.0 : clamp((bound - 0.25) / 0.75, 0.0, 1.0);
}

// The mip level of the place's maps whose texels are as wide as the blur.
float placeLod(float blurMetres) {
    return log2(max(blurMetres * float(textureSize(sunHeights, 0).x) / kPlaceMetres, 1.0));
}

// Sunlight at a place past rock, coral and sand. Half the light of the sun's ray is spread by a
// degree or two: edges soften with the distance to what throws the shadow.
float sunPast(vec3 place) {
    vec2 uv = surfacePoint(place) / kPlaceMetres + 0.5;
    float height = place.y + 0.06;
    if (!kFine) return shareNotAbove(textureLod(sunHeights, uv, 0.0).xy, height);
    float throwerMetres = max(textureLod(sunHeights, uv, placeLod(0.5)).x - height, 0.0);
    return shareNotAbove(textureLod(sunHeights, uv, placeLod(0.05 + 0.05 * throwerMetres)).xy, height);
}

// Light from above past the place: how much of the surroundings stands higher, at three distances.
float skyPast(vec3 place, vec3 normal) {
    if (!kFine) {
        vec2 moments = textureLod(topHeights, place.xz / kPlaceMetres + 0.5, 3.0).xy;
        return shareNotAbove(moments, place.y + 0.1);
    }
    float open = 0.0;
    for (int i = 0; i < 3; ++i) {
        float reach = 0.18 * exp2(1.6 * float(i));
        vec3 from = place + normal * (0.2 * reach + 0.03);
        vec2 moments = textureLod(topHeights, from.xz / kPlaceMetres + 0.5, placeLod(2.0 * reach)).xy;
        open += shareNotAbove(moments, from.y);
    }
    return open / 3.0;
}

// Light past the fish above, as if those on the way were spread like a bell about their mean height.
// The light from above comes through a wider part of the school than the sun's.
float pastFish(vec2 uv, float height, float lod) {
    vec3 sums = textureLod(fishOnTheWay, uv, lod).xyz;
    if (sums.x < 1.0e-3) return 1.0;
    float mean = sums.y / sums.x;
    float spread = sqrt(max(sums.z / sums.x - mean * mean, 0.0) + 0.01);
    float above = 1.0 / (1.0 + exp(-1.7 * (mean - height - 0.18) / spread));
    return exp(-sums.x * above);
}
vec2 fishPlace(vec3 place) { return (surfacePoint(place) - fishWindow.xy) * fishWindow.z + 0.5; }
Occlusion pastFish(vec3 place) {
    vec2 uv = fishPlace(place);
    if (any(greaterThan(abs(uv - 0.5), vec2(0.49)))) return Occlusion(1.0, 1.0);
    if (!kFine) {
        float both = pastFish(uv, place.y, 0.0);
        return Occlusion(both, 0.4 + 0.6 * both);
    }
    float perMetre = fishWindow.z * float(textureSize(fishOnTheWay, 0).x);
    float sun = pastFish(uv, place.y, log2(max(0.05 * perMetre, 1.0)));
    float sky = pastFish(uv, place.y, log2(max(0.9 * perMetre, 1.0)));
    return Occlusion(sun, sky);
}

// The occlusion of what stands in the place, past the place and the fish; the hollows of a thing
// itself are in its own occlusion.
Occlusion openAt(vec3 place, vec3 normal) {
    Occlusion open = Occlusion(sunPast(place + 0.05 * normal), mix(0.25, 1.0, skyPast(place, normal)));
    if (!kFine) return open;
    Occlusion school = pastFish(place);
    return Occlusion(open.sun * school.sun, open.sky * school.sky);
}
#endif
