// The lens before which specks drift, snow and plankton alike. Ranges from the eye in metres.
#ifndef SPECK_LENS_GLSL
#define SPECK_LENS_GLSL
const float kLensMetres = 0.0055, kFocusMetres = 6.0;  // a little out of focus when near
// Angle over which a speck is spread.
float lensBlurRadians(float range) { return kLensMetres * abs(1.0 / range - 1.0 / kFocusMetres); }
// What is nearer than the glass is left out: big discs would draw the eye.
float nearFade(float range) { return smoothstep(0.7, 1.6, range); }
#endif
