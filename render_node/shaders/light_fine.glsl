// Replaces light_plain.glsl in tiers that have the time: soft shadows of several reaches, a
// mirrored reef, clouds, dispersion.
const bool kFine = true;
