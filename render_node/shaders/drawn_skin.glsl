// What a fish wears that a visitor has painted: the drawing, on both sides alike, as living skin.
// Scales, gill covers and the rays of fins are a fish's own; its mirror and its pattern are not there.
// In place of own_skin.glsl. In: a point of the skin or of a fin. Out: as a skin shader has it.
#include "skin_anatomy.glsl"

layout(binding = kDrawnSkinsUnit) uniform sampler2DArray drawnSkins;
layout(location = 11) flat in uint drawing;  // its layer
uniform vec4 sideOfSpecies;  // from (-s, y) to a place of the drawing: factors, then what is added

// White paper is brighter than any skin.
const float kPaper = 0.86;
// How far pigment spreads in skin, body lengths: paper between the strokes of a crayon takes its colour.
const float kPigment = kFine ? 0.011 : 0.005;

// Of dry paper. From near some of it stays as sharp as it was drawn.
vec3 drawnAt(SkinPoint at) {
    vec3 place = vec3(vec2(-at.s, at.y) * sideOfSpecies.xy + sideOfSpecies.zw, float(drawing));
    float texels = max(kPigment, at.pixel) * sideOfSpecies.x * float(textureSize(drawnSkins, 0).x);
    vec3 spread = textureLod(drawnSkins, place, log2(texels)).rgb;
    return kFine ? mix(texture(drawnSkins, place).rgb, spread, 0.5) : spread;
}

// Where it is wet, light meets pigment more than once: colours are deeper. A fish is darker above.
Skin wornGround(SkinPoint at) {
    vec3 dry = drawnAt(at);
    vec3 wet = kPaper * dry * mix(vec3(1.0), sqrt(dry), 0.75);
    return skinOf(wet * (1.0 - 0.35 * smoothstep(0.30, 1.0, at.v)), 0.55, 0.8);
}

void addWornDetails(inout Skin skin, SkinPoint at) {
    layScales(skin, at, 0.06, 0.0165, 0.20, smoothstep(0.16, 0.25, at.s));
    paintGill(skin, at);
}

Fin wornFin(FinPoint fin, Skin root) {
    Fin made = finOf(fin, root);
    made.albedo = root.albedo;
    return made;
}
