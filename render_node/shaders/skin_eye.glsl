// A wet eye, painted where the species has it: a clear dome over an iris that lies deeper.
// In: a skin and a point on it. Out: the skin with the eye; the radius of the eye is
// eyeOfSpecies.z, body lengths.
#ifndef SKIN_EYE_GLSL
#define SKIN_EYE_GLSL
#include "skin.glsl"

// How far the pupil of one eye moves tailwards and upwards, in radii of the eye. gaze: of the fish, in
// its body frame; side: of the eye, 1 right. An eye that cannot see the target looks ahead.
vec2 eyeTurn(vec3 gaze, float side) {
    return vec2(-0.16 * gaze.x - 0.10 * max(-side * gaze.z, 0.0), 0.22 * gaze.y);
}

// dome: how much the painted eye bulges: less where the mesh has a ball for it.
// look: unit vector to the eye of the beholder, towards the tail, upwards and out of the skin.
// turn: of the fish's eye, so far its pupil moves tailwards and upwards, in its radii.
// Returns how much of the pixel the fish's eye covers.
float paintEye(inout Skin skin, SkinPoint at, Iris iris, float dome, vec3 look, vec2 turn) {
    vec2 from = (vec2(at.s, at.y) - eyeOfSpecies.xy) / eyeOfSpecies.z;
    float d = length(from);
    // Around the eye the skin sinks and darkens.
    skin.albedo *= 1.0 - 0.38 * falling(1.0, 1.30, d);
    if (d > 1.3) return 0.0;
    float soft = 0.7 * at.pixel / eyeOfSpecies.z;
    float coverage = falling(1.0 - soft, 1.0 + soft, d);

    // The iris lies behind the cornea: it moves under it with the beholder.
    vec2 deep = from - 0.26 * look.xy / max(look.z, 0.45) * falling(0.2, 1.0, d);
    deep -= turn * falling(0.5, 1.0, d);
    float r = length(deep);
    float pupil = falling(iris.pupil - 0.03 - soft, iris.pupil + 0.03 + soft,
                          length(deep * vec2(iris.upright, 1.0)));
    float angle = atan(deep.y, deep.x);
    float detail = seenAt(0.3 * eyeOfSpecies.z, at.pixel);
    float streaks = 0.5 + 0.5 * sin(angle * 23.0 + 3.0 * sin(angle * 7.0)) * detail;
    vec3 colour = iris.colour * (0.68 + 0.18 * streaks + 0.25 * falling(0.5, 0.75, r));
    colour *= 1.0 - 0.45 * smoothstep(0.25, 0.95, deep.y);  // dusky above
    colour = mix(colour, iris.ring, 0.6 * line(r - iris.pupil - 0.07, 0.05, 2.0 * soft));
    colour = mix(colour, vec3(0.002, 0.003, 0.005), pupil);
    colour = mix(colour, vec3(0.010, 0.012, 0.014), 0.88 * smoothstep(0.84, 0.98, d));

    skin.albedo = mix(skin.albedo, colour, coverage);
    skin.silver *= 1.0 - coverage;
    skin.iridescence *= 1.0 - coverage;
    skin.gloss = mix(skin.gloss, 1.0, coverage);
    skin.tilt = mix(skin.tilt, dome * from * smoothstep(0.1, 1.0, d), coverage);
    skin.flicker *= 1.0 - coverage;
    return coverage;
}
#endif
