// SPDX-License-Identifier: Apache-2.0
// Versions of how fish move, one for the motor and one for the minds. Documents name those of which
// their figures are. tests/master/study/versions_test.cpp fails where fish move otherwise than in
// the version that is entered here.
#pragma once

namespace aquarama {

// Of the motor: repertoires, as they are captured, and how they are played. Raise it when the same
// commands move a fish otherwise.
inline constexpr int kMotorVersion = 1;
// Of the minds and what they perceive: scenes, habits, routines, secondary controller. Raise it
// when the fish of a scene move otherwise with the same motor.
inline constexpr int kMindsVersion = 2;

}  // namespace aquarama
