// SPDX-License-Identifier: Apache-2.0
// The constants of how a face moves, for face.cpp and the shader that draws it. Compiled as C++ and
// as GLSL.
#ifndef AQUARAMA_FACE_MOTION_H
#define AQUARAMA_FACE_MOTION_H
#ifdef __cplusplus
#define AQUARAMA_CONSTANT inline constexpr
namespace aquarama::body {
#else
#define AQUARAMA_CONSTANT const
#endif

// Breaths a second of a fish of one metre; they go with the length to the power of kBreathPower.
AQUARAMA_CONSTANT float kBreathHertz = 0.6F;
AQUARAMA_CONSTANT float kBreathPower = -0.38F;
AQUARAMA_CONSTANT float kLeastBreathHertz = 0.3F;
AQUARAMA_CONSTANT float kMostBreathHertz = 2.0F;
// Shares of the widest gape: of a breath of a fish that rests, and of one at speed, which lets the
// water flow through.
AQUARAMA_CONSTANT float kRestingBreath = 0.30F;
AQUARAMA_CONSTANT float kSwimmingBreath = 0.10F;
// Above the second speed a fish breathes least, below the first most. Body lengths a second.
AQUARAMA_CONSTANT float kBreathesDeep = 0.2F;
AQUARAMA_CONSTANT float kBreathesFlat = 1.8F;
// The gill cover follows the mouth by so much of a breath, cycles.
AQUARAMA_CONSTANT float kGillLag = 0.35F;
// Of the gill cover's lift: of a fish at speed against one at rest, and of one that gapes.
AQUARAMA_CONSTANT float kSwimmingGill = 0.35F;
AQUARAMA_CONSTANT float kGapingGill = 0.6F;

#ifdef __cplusplus
}  // namespace aquarama::body
#endif
#undef AQUARAMA_CONSTANT
#endif
