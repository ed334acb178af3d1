// A corner of a rock: where it is, and how open to the light.
// In: the vertex and the chosen instance. Out: world metres; lightness, turf and pink crust; tint and
// occlusion as shares.
#include "instance.glsl"
#include "solid_vertex.glsl"
layout(location = kReachLocation) uniform float reach;
struct RockCorner {
    vec3 place, normal, mottle, tint;
    vec2 open;  // to the sun, to the light from above
};
RockCorner rockCorner() {
    Instance one = instanceOf(chosen);
    FadedVertex vertex = fadedVertex();
    // Pebbles shrink before they vanish.
    float shown = smoothstep(4.0, 7.0, reach * pixelsOf(one.placeAndScale));
    float scale = shown * one.placeAndScale.w;
    RockCorner it;
    it.place = one.placeAndScale.xyz + scale * turned(one.turn, vertex.position);
    it.normal = turned(one.turn, vertex.normal);
    it.mottle = vertex.albedoAndSky.rgb;
    it.tint = one.tintAndSway.rgb;
    float above = (it.place.y - one.sandHeightMetres) / min(one.placeAndScale.w, 1.0);
    float contact = mix(0.4, 1.0, smoothstep(-0.1, 0.6, above));
    float own = vertex.albedoAndSky.w;
    it.open = vec2(one.occlusion.x * mix(0.3, 1.0, own), one.occlusion.y * own * sqrt(own) * contact);
    return it;
}
