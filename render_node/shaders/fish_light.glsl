// How the skin of a fish reflects and scatters light. Radiances in linear Rec. 709, relative to an
// irradiance of 1 at the surface; vectors are unit vectors in the world.
#ifndef FISH_LIGHT_GLSL
#define FISH_LIGHT_GLSL
#include "light.glsl"
#include "skin.glsl"

// The palettes were drawn for paper, from plates in daylight: wet skin is darker by this factor.
const float kWet = 0.78;
vec3 wetAlbedo(vec3 albedo, uint id) { return min(kWet * albedo * tintOf(id), vec3(1.0)); }

// Light goes a little way through skin, so that the border of its shadow is soft: the sun's
// cosine c becomes (c + w) / |n + w s|. What looks down has the fish's own shadow below it, and
// sees less of the lit sand.
vec3 litSkin(Skin skin, vec3 place, vec3 n) {
    vec3 wrapped = normalize(n + 0.35 * skin.soft * sunAndFilterDepth.xyz);
    float open = mix(0.55, 1.0, smoothstep(-1.0, 0.6, n.y));
    return lit(skin.albedo, place, wrapped, 0.10 * skin.soft) * open;
}

// What a mirror in the skin reflects of the sea floor: sand, darker rock where the ground stands
// higher, as far as the water between lets it through.
const vec3 kSandAround = vec3(0.42, 0.34, 0.24), kRockAround = vec3(0.20, 0.15, 0.10);
vec3 withBottom(vec3 sea, vec3 direction, vec3 place) {
    float share = unscatteredShare(max(-place.y, 0.1));
    vec3 light = 0.8 * share * sunlight.rgb + (1.0 - share) * skylight.rgb;
    float fall = max(-direction.y, 0.04), metres = 2.0, raised = 0.3;
    if (kFine) {
        float below = textureLod(topHeights, place.xz / kPlaceMetres + 0.5, placeLod(1.2)).x;
        metres = min(max(place.y - below, 0.05) / fall, 30.0);
        vec2 hit = place.xz + direction.xz * metres;
        float height = textureLod(topHeights, hit / kPlaceMetres + 0.5, placeLod(0.3)).x;
        raised = smoothstep(0.15, 0.7, height + kMeanFloorMetres);
    }
    vec3 ground = mix(kSandAround, kRockAround, raised) * light / kPi;
    float clear = exp(-0.14 * metres) * smoothstep(0.10, -0.20, direction.y);
    return mix(sea, ground, bottom.x * clear);
}

// The light that a mirror in the skin reflects: of the open water and the surface, of the sea floor, and
// of the fish beside it, which stand darker before the sea.
vec3 around(vec3 direction, vec3 place) {
    vec3 sea = max(mirrored(direction, place), 0.0);
    if (kFine) sea *= mix(0.7, 1.0, pastFish(place + 0.5 * direction).sky);
    return withBottom(sea, direction, place);
}

// Stacks of guanine platelets hang upright whatever the curve of the skin (Denton 1970), so that a
// flank shows the level water around it: it vanishes, and flashes when the fish rolls. A platelet
// that would face away is seen by its other side.
const float kUpright = 0.78;
vec3 plateletNormal(vec3 skinNormal, vec3 dorsal, vec3 toEye) {
    vec3 plate = skinNormal - kUpright * dot(skinNormal, dorsal) * dorsal;
    float behind = min(dot(plate, toEye), 0.0);
    return normalize(plate - 2.0 * behind * toEye);
}

// Thin films colour the mirror faintly; a stronger tint would look like soap.
vec3 filmTint(float facing) {
    return 0.97 + 0.06 * cos(6.2831853 * (vec3(0.0, 0.33, 0.67) + 1.35 * facing));
}

// Structural colour: the albedo's hue turns with the angle of view.
vec3 iridescent(vec3 albedo, float amount, float facing) {
    vec3 phase = 6.2831853 * (1.1 * facing + vec3(0.0, 0.33, 0.67));
    return albedo * (1.0 + 0.9 * amount * cos(phase));
}

// A platelet that faces the lamp reflects its light straight back. Platelets stand at all angles about
// the upright axis, so some do.
vec3 lampFlash(vec3 plate, vec3 place) {
    vec3 toLamp = normalize(lamp.xyz - place);
    float c = max(dot(plate, toLamp), 0.0);
    c *= c; c *= c; c *= c; c *= c;
    return lampLight(place, toLamp) * (0.04 * c * c);
}

// The flesh absorbs the light that platelets let through: the more silver, the darker it is.
vec3 underSilver(vec3 matte, vec3 mirror, float silver) {
    return mirror * silver + matte * ((1.0 - silver) * (1.0 - 0.85 * silver));
}

// The light of a mirror of platelets. shown: the light from the direction that it reflects.
vec3 silvered(vec3 shown, vec3 plate, vec3 albedo, vec3 place, float facing) {
    return (shown + lampFlash(plate, place)) * filmTint(facing) * mix(vec3(1.0), albedo, 0.12);
}

// Mucus over the skin: a weak mirror, most at grazing angles and on what faces upwards, less where
// the outline is narrower than a pixel.
vec3 sheenOf(vec3 shown, float gloss, float facing, float up, float pixel) {
    float resolved = clamp(0.003 / pixel, 0.0, 1.0);
    float grazing = (1.0 - facing) * (1.0 - facing) * resolved;
    float wet = gloss * (0.025 + 0.25 * grazing * grazing);
    return min(shown * (wet * (0.6 + 0.4 * up)), vec3(0.10 * resolved));
}

// The cornea mirrors Snell's window above and the sun in it: more than that of a real eye, which is
// nearly as dense as water, but eyes without a catch light look dead.
vec3 cornea(vec3 direction, float facing) {
    float towardsSun = dot(direction, sunAndFilterDepth.xyz) - 1.0;
    float window = 0.09 * smoothstep(0.86, 0.93, direction.y);
    float grazing = 1.0 - facing;
    float share = 0.8 + 2.0 * grazing * grazing * grazing;
    return share * (window * skylight.rgb + 0.8 * exp(110.0 * towardsSun) * sunlight.rgb);
}
#endif
