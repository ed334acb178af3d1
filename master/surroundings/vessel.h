// SPDX-License-Identifier: Apache-2.0
// Rotations by exact arithmetic: two machines' libm do not agree to the bit. Radians.
#pragma once

#include <cmath>
#include <vector>

#include <glm/vec3.hpp>

#include "common/motion/motion_state.h"
#include "common/place/place.h"
#include "common/units/units.h"
#include "master/surroundings/climate.h"

namespace aquarama::surroundings {

struct SineCosine {
    float sine = 0;
    float cosine = 1;
};

// Of angles up to some turns, within 1e-6: Taylor's series about the nearest quarter turn.
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

// The same angle, -pi to pi.
[[nodiscard]] inline float wrapped(float radians) {
    return radians - motion::roundToEven(radians / (2 * place::kPi)) * (2 * place::kPi);
}

// How the submarine stands in the world. Without any it looks along -z.
struct Attitude {
    float yaw = 0;    // about the world's up, to the left
    float pitch = 0;  // nose up
    float roll = 0;   // right side up
};

[[nodiscard]] inline motion::Quaternion worldFromBody(const Attitude& attitude) {
    const auto [ys, yc] = sineAndCosine(attitude.yaw / 2);
    const auto [ps, pc] = sineAndCosine(attitude.pitch / 2);
    const auto [rs, rc] = sineAndCosine(attitude.roll / 2);
    return motion::normalised(motion::Quaternion{yc, 0, ys, 0} * motion::Quaternion{pc, ps, 0, 0} *
                              motion::Quaternion{rc, 0, 0, rs});
}

// Along the nose; to the right, level.
[[nodiscard]] inline glm::vec3 noseOf(const Attitude& attitude) {
    const auto [ys, yc] = sineAndCosine(attitude.yaw);
    const auto [ps, pc] = sineAndCosine(attitude.pitch);
    return {-ys * pc, ps, -yc * pc};
}
[[nodiscard]] inline glm::vec3 rightOf(const Attitude& attitude) {
    const auto [ys, yc] = sineAndCosine(attitude.yaw);
    return {yc, 0, -ys};
}

// The submarine as a body: thrusters push it, water holds it back. World frame: metres, Y up;
// radians, seconds, kilograms, newtons.

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

// What the submarine must not run into: sand, rocks, kelp, the surface and the borders of the
// scene. World frame, metres.

inline constexpr float kHullRadiusMetres = 0.5F;  // about the eye: nothing comes nearer to it
inline constexpr float kStandOffMetres = 0.25F;   // off the hull, where it is pushed back
inline constexpr float kBrakingMetres = 1.1F;     // a second squared, before an obstacle

// Where the submarine may go.
struct Waters {
    place::PlaceKey place;
    place::Region region;
    std::vector<place::Rock> rocks;
    std::vector<Stem> stems;
};
[[nodiscard]] Waters watersOf(const place::PlaceKey& place,
                              const place::Region& fishWater,
                              glm::vec3 eye);

// How far the hull is from all of it; negative inside something.
[[nodiscard]] float gapAt(const Waters& waters, glm::vec3 position);

// One tick of movement. What leads at an obstacle is braked in time, so that it comes to rest at
// the stand-off, and within that it is led away gently. Never ends inside anything that the hull
// was outside of.
void moveHull(const Waters& waters, glm::vec3& position, glm::vec3& velocity);

}  // namespace aquarama::surroundings
