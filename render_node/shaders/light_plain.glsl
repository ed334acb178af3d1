// Leaves out what the lowest tier has no time for; see light_fine.glsl.
const bool kFine = false;
