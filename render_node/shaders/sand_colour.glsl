// Albedo of dry sand, linear Rec. 709.
// A constant alone, for either stage.
const vec3 kSand = vec3(0.52, 0.41, 0.27);
