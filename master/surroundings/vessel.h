// SPDX-License-Identifier: Apache-2.0
// The submarine as a body: its rotations, its thrusters and drag, and what it must not run into.
// All by exact arithmetic without libm, because two machines' libm differ in the last bits.
// Radians.
#pragma once

#include <cmath>
#include <vector>

#include <glm/vec3.hpp>

#include "common/base/units.h"
#include "common/motion/motion_state.h"
#include "common/place/obstacles.h"
#include "common/place/place.h"

namespace aquarama::surroundings {

// Sine and cosine of one angle.
struct SineCosine {
    float sine = 0;
    float cosine = 1;
};

// Within 1e-6 for angles up to some turns: Taylor's series about the nearest quarter turn.
[[nodiscard]] inline SineCosine sineAndCosine(float radians) {
    const float quarters = motion::roundToEven(radians * (2 / place::kPi));
    const float x = radians - quarters * (place::kPi / 2);
    const float s = x * x;
    const float sine = x * (1 - s / 6 * (1 - s / 20 * (1 - s / 42)));
    const float cosine = 1 - s / 2 * (1 - s / 12 * (1 - s / 30 * (1 - s / 56)));
    switch (static_cast<int>(quarters) & 3) {
        case 0:
            return {sine, cosine};
        case 1:
            return {cosine, -sine};
        case 2:
            return {-sine, -cosine};
        default:
            return {-cosine, sine};
    }
}

// The equal angle in -pi to pi.
[[nodiscard]] inline float wrapped(float radians) {
    return radians - motion::roundToEven(radians / (2 * place::kPi)) * (2 * place::kPi);
}

// Orientation of the submarine. All 0: it looks along -z. Applied as yaw, then pitch, then roll.
// Radians; of a rate, radians a second.
struct Attitude {
    // About the world's up, to the left.
    float yaw = 0;
    // Pitch, nose up.
    float pitch = 0;
    // Roll, right side up.
    float roll = 0;
};

// The rotation, computed from half angles.
[[nodiscard]] inline motion::Quaternion worldFromBody(const Attitude& attitude) {
    const auto [ys, yc] = sineAndCosine(attitude.yaw / 2);
    const auto [ps, pc] = sineAndCosine(attitude.pitch / 2);
    const auto [rs, rc] = sineAndCosine(attitude.roll / 2);
    return motion::normalised(motion::Quaternion{yc, 0, ys, 0} * motion::Quaternion{pc, ps, 0, 0} *
                              motion::Quaternion{rc, 0, 0, rs});
}

// Unit vectors in the world frame: along the nose, and below it to the right and level.
[[nodiscard]] inline glm::vec3 noseOf(const Attitude& attitude) {
    const auto [ys, yc] = sineAndCosine(attitude.yaw);
    const auto [ps, pc] = sineAndCosine(attitude.pitch);
    return {-ys * pc, ps, -yc * pc};
}
[[nodiscard]] inline glm::vec3 rightOf(const Attitude& attitude) {
    const auto [ys, yc] = sineAndCosine(attitude.yaw);
    return {yc, 0, -ys};
}

// Thrust, mass and drag. World frame: metres, Y up; radians, seconds, kilograms, newtons.

inline constexpr float kTickSeconds = 1.0F / 60.0F;

// Mass including the water that it carries along (added mass).
inline constexpr float kVesselKilograms = 1800;
// Full thrust along the nose.
inline constexpr float kThrustNewtons = 1440;
// Full thrust to the side, up and down.
inline constexpr float kSideThrustNewtons = 800;
// Drag at speed v is a v + b v^2: the linear part acts at low speed, the square at high speed.
inline constexpr float kDragNewtonsPerSpeed = 720;
inline constexpr float kDragNewtonsPerSpeedSquared = 400;
// Radians a second at full turn.
inline constexpr float kFastestTurn = 0.35F;
// Rate at which the turn follows the push, a second.
inline constexpr float kTurnDamping = 2;
inline constexpr float kSteepestPitch = 0.436F;  // 25 degrees
inline constexpr float kStrongestBank = 0.087F;  // 5 degrees
// Fastest change of a push that a visitor asks for, a second.
inline constexpr float kHandsSlew = 2.5F;

// Pushes of thrusters and rudders, each -1 to 1; axes and signs as in Steering.
struct Push {
    float ahead = 0, aside = 0, up = 0, turn = 0, tilt = 0;
};
// Converts whole numbers of the wire to shares of full push.
[[nodiscard]] Push pushOf(const Steering& steering);

// State of the submarine's body.
struct Vessel {
    // Position of the eye, metres.
    glm::vec3 position{};
    // Velocity, metres a second.
    glm::vec3 velocity{};
    Attitude attitude;
    // Rate of the attitude, radians a second.
    Attitude rate;
    // Pushes in effect now.
    Push push;
};

// Applies thrusters, rudders and drag for one tick: changes velocity, attitude and its rate. The
// pushes follow the wanted ones by at most `slew` (above 0) a second, so that no steering jerks.
// The position stays: moveHull() changes it.
void pushVessel(Vessel& vessel, const Push& wanted, float slew);

// Speed at which the drag equals this thrust, metres a second.
[[nodiscard]] float terminalSpeed(float newtons);

// Obstacles of the submarine: sand, rocks, kelp, the surface and the borders of the scene. World
// frame, metres.

// Radius of the hull, a ball around the eye.
inline constexpr float kHullRadiusMetres = 0.5F;
// Distance off the hull within which it is pushed back.
inline constexpr float kStandOffMetres = 0.25F;
// Braking before an obstacle, metres a second squared.
inline constexpr float kBrakingMetres = 1.1F;

// The limits of the submarine. Made once for a scene, constant.
struct Waters {
    place::PlaceKey place;
    place::Region region;
    std::vector<place::Rock> rocks;
    std::vector<place::Stem> stems;
};
// The region is that of the fish, extended around the eye (place::roamingRegion()).
[[nodiscard]] Waters watersOf(const place::PlaceKey& place,
                              const place::Region& fishWater,
                              glm::vec3 eye);

// Distance from the hull to the nearest obstacle; negative inside one. Distances beyond 2 m are
// given as 2 m.
[[nodiscard]] float gapAt(const Waters& waters, glm::vec3 position);

// Moves the hull by one tick. Velocity towards an obstacle is braked in time, so that the hull
// comes to rest at the stand-off; within the stand-off it is led away gently. A hull that was
// outside every obstacle never ends inside one.
void moveHull(const Waters& waters, glm::vec3& position, glm::vec3& velocity);

}  // namespace aquarama::surroundings
