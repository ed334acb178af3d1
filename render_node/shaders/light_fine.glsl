// Replaces light_plain.glsl in finer tiers: soft shadows of several reaches, a mirrored reef, clouds,
// dispersion.
const bool kFine = true;
