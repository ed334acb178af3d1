// SPDX-License-Identifier: Apache-2.0
// The submarine as a body: thrusters push it, water holds it back. World frame: metres, Y up;
// radians, seconds, kilograms, newtons.
#pragma once

#include <glm/vec3.hpp>

#include "common/units/steering.h"
#include "master/pilot/rotation.h"

namespace aquarama::pilot {

inline constexpr float kTickSeconds = 1.0F / 60.0F;

// With the water that it carries along.
inline constexpr float kVesselKilograms = 1800;
inline constexpr float kThrustNewtons = 1440;     // along the nose
inline constexpr float kSideThrustNewtons = 800;  // to the side, up and down
// Drag is a v + b v^2: slow water clings, fast water is pushed away.
inline constexpr float kDragNewtonsPerSpeed = 720;
inline constexpr float kDragNewtonsPerSpeedSquared = 400;
inline constexpr float kFastestTurn = 0.35F;     // radians a second
inline constexpr float kTurnDamping = 2;         // a second
inline constexpr float kSteepestPitch = 0.436F;  // 25 degrees
inline constexpr float kStrongestBank = 0.087F;  // 5 degrees
inline constexpr float kHandsSlew = 2.5F;        // how fast a push may change, a second

// What thrusters and rudders give, each -1 to 1; as Steering has them.
struct Push {
    float ahead = 0, aside = 0, up = 0, turn = 0, tilt = 0;
};
[[nodiscard]] Push pushOf(const Steering& steering);

struct Vessel {
    glm::vec3 position{};  // of the eye
    glm::vec3 velocity{};  // metres a second
    Attitude attitude;
    Attitude rate;  // of the attitude, a second
    Push push;
};

// What the thrusters do in one tick, and the drag: velocity, attitude and its rate afterwards. The
// push follows what is wanted by at most `slew` a second, so that no hand jerks. The place stays:
// what stands in the way is asked first (hull.h).
void pushVessel(Vessel& vessel, const Push& wanted, float slew);

// The speed that so much thrust comes to, metres a second.
[[nodiscard]] float terminalSpeed(float newtons);

}  // namespace aquarama::pilot
