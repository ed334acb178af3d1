// Included instead of light_plain.glsl by tiers that can pay for it: soft shadows of several reaches, a
// mirrored reef, clouds, dispersion.
const bool kFine = true;
