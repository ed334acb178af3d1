// What a fish wears that a visitor has painted: the drawing, on both sides alike, as living skin.
// Scales, gill covers and the rays of fins are a fish's own; its mirror and its pattern are not there.
// In place of own_skin.glsl. In: a point of the skin or of a fin. Out: as a skin shader has it.
#include "skin_anatomy.glsl"

layout(binding = kDrawnSkinsUnit) uniform sampler2DArray drawnSkins;
layout(location = 11) flat in uint drawing;  // its layer
uniform vec4 sideOfSpecies;  // from (-s, y) to a place of the drawing: factors, then what is added

// White paper is brighter than any skin.
const float kPaper = 0.86;

Skin wornGround(SkinPoint at) {
    vec2 place = vec2(-at.s, at.y) * sideOfSpecies.xy + sideOfSpecies.zw;
    return skinOf(kPaper * texture(drawnSkins, vec3(place, float(drawing))).rgb, 0.45, 0.8);
}

void addWornDetails(inout Skin skin, SkinPoint at) {
    layScales(skin, at, 0.06, 0.015, 0.15, smoothstep(0.16, 0.25, at.s));
    paintGill(skin, at);
}

Fin wornFin(FinPoint fin, Skin root) {
    Fin made = finOf(fin, root);
    made.albedo = root.albedo;
    return made;
}
