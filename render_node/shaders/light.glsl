// The light that falls on things, and the part of it that reaches the shared eye. Include this in a
// fragment shader and write seen(lit(...), place). Places and normals in the world; it uses
// derivatives, hence fragment shaders only. Result: outgoing radiance of a matte surface.
#ifndef LIGHT_GLSL
#define LIGHT_GLSL
#include "shading.glsl"

// The lod of the caustics for what a pixel covers here: the root of its area. The longer side alone would blur the sand
// too much, and an area does not depend on the rotation of a channel's picture.
float causticLod(vec3 place) {
    return log2(1.0 + sqrt(length(cross(dFdx(place), dFdy(place)))) * (256.0 / kTileMetres));
}

vec3 litUnder(Occlusion open, vec3 albedo, vec3 place, vec3 normal, float translucency) {
    return litAt(causticLod(place), open, albedo, place, normal, translucency);
}

// The light of things that swim, with the shadows of other fish.
vec3 lit(vec3 albedo, vec3 worldPosition, vec3 normal, float translucency) {
    return litUnder(pastFish(worldPosition), albedo, worldPosition, normal, translucency);
}
#endif
