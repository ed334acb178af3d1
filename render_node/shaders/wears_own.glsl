// Which fish a vertex shader draws: those that wear the skin of their species.
// wears_drawing.glsl takes its place for the others.
const bool kWearsDrawing = false;
const vec4 kNowhere = vec4(2.0, 2.0, 2.0, 1.0);  // of the others
