// Skin of a species that has no skin shader: the colours of its file, dark above and pale below.
// Members as skin.glsl describes them: SkinPoint in, linear Rec. 709 albedo and mirror out.
#ifndef SKIN_PLAIN_GLSL
#define SKIN_PLAIN_GLSL
#include "skin_anatomy.glsl"

const Iris kIris = Iris(vec3(0.40, 0.34, 0.20), vec3(0.60, 0.52, 0.30), 0.47, 1.0);

Skin groundOf(SkinPoint at) {
    vec3 colour = shadedGround(at.v, groundColours[0], groundColours[1], groundColours[2]);
    return skinOf(colour, 0.5, 0.5);
}

void addDetails(inout Skin skin, SkinPoint at) {
    layScales(skin, at, 0.05, 0.016, 0.14, smoothstep(0.22, 0.28, at.s));
    paintGill(skin, at);
}

Fin finOf(FinPoint fin, Skin root) { return Fin(root.albedo, 0.80, 18.0, 0.0, 0.35); }
#endif
