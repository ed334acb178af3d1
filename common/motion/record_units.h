// SPDX-License-Identifier: Apache-2.0
// The units of a fish's record on the wire and on the GPU. Compiled as C++ and as GLSL.
#ifndef AQUARAMA_RECORD_UNITS_H
#define AQUARAMA_RECORD_UNITS_H
#ifdef __cplusplus
#define AQUARAMA_CONSTANT inline constexpr
namespace aquarama::motion {
#else
#define AQUARAMA_CONSTANT const
#endif

AQUARAMA_CONSTANT float kPositionUnitMetres = 1.0F / 65536.0F;
AQUARAMA_CONSTANT float kPhaseUnit = 1.0F / 65536.0F;          // cycles
AQUARAMA_CONSTANT float kSpeedUnitsPerBodyLength = 262144.0F;  // 2^18; body lengths a second
AQUARAMA_CONSTANT float kMostSpread = 255.0F;                  // units of a spread of 1
// Of a component of a quaternion. No component but the largest exceeds 1 / sqrt(2), which is 2^19
// units.
AQUARAMA_CONSTANT float kOrientationUnitsPerOne = 741455.2F;  // 2^19 * sqrt(2)
AQUARAMA_CONSTANT float kOrientationUnit = 1.0F / kOrientationUnitsPerOne;

// A fish that is not in the water: it was eaten, and no other has come in its place yet. It keeps
// its index; its body frame is so far below every sea floor that no wall ever shows it.
AQUARAMA_CONSTANT float kAwayHeightMetres = -16384.0F;
// A fish below this height is away, in position units: half of kAwayHeightMetres, as the motor may
// move an absent fish.
AQUARAMA_CONSTANT int kAwayBelow = -8192 * 65536;

#ifdef __cplusplus
}  // namespace aquarama::motion
#endif
#undef AQUARAMA_CONSTANT
#endif
