// SPDX-License-Identifier: Apache-2.0
// The constants of how fins move, for fins.cpp and the shader that draws them. Compiled as C++ and
// as GLSL.
#ifndef AQUARAMA_FIN_MOTION_H
#define AQUARAMA_FIN_MOTION_H
#ifdef __cplusplus
#define AQUARAMA_CONSTANT inline constexpr
namespace aquarama::body {
#else
#define AQUARAMA_CONSTANT const
#endif

AQUARAMA_CONSTANT float kWholeTurn = 6.2831853F;  // radians
// The period of all fin motion that depends on the time: all rates are whole tenths of a hertz.
AQUARAMA_CONSTANT float kFinSeconds = 10.0F;
// The margin of a membrane follows its root by a sixth of a beat, radians.
AQUARAMA_CONSTANT float kMarginLag = kWholeTurn / 6.0F;
// Below the first speed a fish stands, above the second it swims. Body lengths a second.
AQUARAMA_CONSTANT float kStands = 0.2F;
AQUARAMA_CONSTANT float kSwims = 0.6F;
AQUARAMA_CONSTANT float kFolded = 1.5F;  // above it pelvic fins lie as near to the belly as they go
// The lobes of a tail fin bend no further than at this drift, body lengths in a radian of the beat:
// that of a fast gait. A fast start sweeps the tail several times as far.
AQUARAMA_CONSTANT float kMostDrift = 0.2F;
AQUARAMA_CONSTANT float kMostFinAngle =
    3.2767F;                               // radians: of a captured pose of a pectoral fin, 16 bits
AQUARAMA_CONSTANT float kTrimGain = 3.0F;  // a slope of a third is steep

#ifdef __cplusplus
}  // namespace aquarama::body
#endif
#undef AQUARAMA_CONSTANT
#endif
