// The light that falls on things and what of theirs reaches the shared eye. Include this in a
// fragment shader and write seen(lit(...), place).
// Places and normals in the world; it uses derivatives, hence fragment shaders only. Result:
// outgoing radiance of a matte surface.
#ifndef LIGHT_GLSL
#define LIGHT_GLSL
#include "shading.glsl"

vec3 litUnder(Occlusion open, vec3 albedo, vec3 place, vec3 normal, float translucency) {
    // Root of the area that a pixel covers: the longer side alone would blur the sand away, and an
    // area is the same whichever way a neighbour's picture is turned.
    float footprint = sqrt(length(cross(dFdx(place), dFdy(place)))) * (256.0 / kTileMetres);
    return litAt(log2(1.0 + footprint), open, albedo, place, normal, translucency);
}

// What swims, past other fish.
vec3 lit(vec3 albedo, vec3 worldPosition, vec3 normal, float translucency) {
    return litUnder(pastFish(worldPosition), albedo, worldPosition, normal, translucency);
}
#endif
