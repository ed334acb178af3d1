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
// Phase lags, in radians and in cycles: the margin of a membrane follows its root by a sixth of a
// beat, the tip of a rowing fin follows its root by an eighth.
AQUARAMA_CONSTANT float kMarginLag = kWholeTurn / 6.0F;
AQUARAMA_CONSTANT float kTipLag = 0.12F;
// Below the first speed a fish stands, above the second it swims. Body lengths a second.
AQUARAMA_CONSTANT float kStands = 0.2F;
AQUARAMA_CONSTANT float kSwims = 0.6F;
AQUARAMA_CONSTANT float kFolded = 1.5F;  // above it pelvic fins lie as near to the belly as they go
AQUARAMA_CONSTANT float kFoldBand = 0.2F;  // of the speed at which fins fold, to either side
AQUARAMA_CONSTANT float kTrimGain = 3.0F;  // a slope of a third is steep

#ifdef __cplusplus
}  // namespace aquarama::body
#endif
#undef AQUARAMA_CONSTANT
#endif
