// How passing fish stir the water near them: their momentum on a coarse grid of the world about the
// shared eye, in integers, so that the order of the additions does not matter. Cells lie at whole
// multiples of their side, so that the grid may follow the eye and no value changes. Three integers for
// each cell: momentum along world x, y, z. wakeIndex() gives the first of them.
#ifndef WAKE_GLSL
#define WAKE_GLSL
#include "shader_interface.h"
#include "frame_uniforms.h"
const ivec3 kWakeCells = ivec3(kWakeCellsAcross, kWakeCellsUp, kWakeCellsAcross);
const float kWakeCellMetres = 0.5;
const float kWakeUnit = 1.0 / 1024.0;  // m/s, of a fish of a quarter of a metre

ivec3 firstWakeCell() {
    return ivec3(floor(sharedEyeAndPixel.xyz / kWakeCellMetres)) - kWakeCells / 2;
}
// -1 outside of the grid.
int wakeIndex(ivec3 cell) {
    ivec3 at = cell - firstWakeCell();
    if (any(lessThan(at, ivec3(0))) || any(greaterThanEqual(at, kWakeCells))) return -1;
    return 3 * ((at.z * kWakeCells.y + at.y) * kWakeCells.x + at.x);
}
#endif
