// Omits what is too slow for the lowest tier; see light_fine.glsl.
const bool kFine = false;
