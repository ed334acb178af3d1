// Which fish a vertex shader draws: those that wear a drawing of a visitor. In place of
// wears_own.glsl.
const bool kWearsDrawing = true;
const vec4 kNowhere = vec4(2.0, 2.0, 2.0, 1.0);  // of the others
