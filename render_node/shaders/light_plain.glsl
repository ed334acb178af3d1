// What the tiers up to low leave out; see light_fine.glsl.
const bool kFine = false;
