// SPDX-License-Identifier: Apache-2.0
#include "master/pilot/vessel.h"

#include <algorithm>
#include <cmath>

namespace aquarama::pilot {

namespace {

constexpr float kPitchFrequency = 1.2F;  // radians a second of the critically damped spring by
constexpr float kRollFrequency = 1.5F;   // which a hull that is heavy below rights itself
constexpr float kBankPerTurn = 0.2F;     // radians a (radian a second times metre a second)

float shareOf(std::int8_t axis) {
    return std::max(static_cast<float>(axis) / float{kFullSteering}, -1.0F);
}

float towards(float from, float to, float most) {
    return from + std::clamp(to - from, -most, most);
}

// One tick of a critically damped spring.
void settle(float target, float frequency, float& angle, float& rate) {
    rate += (frequency * (target - angle) - 2 * rate) * frequency * kTickSeconds;
    angle += rate * kTickSeconds;
}

void turn(Vessel& vessel) {
    Attitude& is = vessel.attitude;
    Attitude& rate = vessel.rate;
    rate.yaw += kTurnDamping * (kFastestTurn * vessel.push.turn - rate.yaw) * kTickSeconds;
    is.yaw = wrapped(is.yaw + rate.yaw * kTickSeconds);
    settle(kSteepestPitch * vessel.push.tilt, kPitchFrequency, is.pitch, rate.pitch);
    is.pitch = std::clamp(is.pitch, -kSteepestPitch, kSteepestPitch);
    const float speedAhead = place::dot(vessel.velocity, noseOf(is));
    const float bank =
        std::clamp(kBankPerTurn * rate.yaw * speedAhead, -kStrongestBank, kStrongestBank);
    settle(bank, kRollFrequency, is.roll, rate.roll);
}

}  // namespace

Push pushOf(const Steering& steering) {
    return {shareOf(steering.ahead),
            shareOf(steering.aside),
            shareOf(steering.up),
            shareOf(steering.turn),
            shareOf(steering.tilt)};
}

void pushVessel(Vessel& vessel, const Push& wanted, float slew) {
    Push& push = vessel.push;
    const float most = slew * kTickSeconds;
    push = {towards(push.ahead, wanted.ahead, most),
            towards(push.aside, wanted.aside, most),
            towards(push.up, wanted.up, most),
            towards(push.turn, wanted.turn, most),
            towards(push.tilt, wanted.tilt, most)};
    turn(vessel);
    const glm::vec3 newtons = noseOf(vessel.attitude) * (kThrustNewtons * push.ahead) +
                              rightOf(vessel.attitude) * (kSideThrustNewtons * push.aside) +
                              glm::vec3{0, kSideThrustNewtons * push.up, 0};
    // Drag is taken at the end of the tick: whatever the speed, it brakes and never turns back.
    const float drag =
        kDragNewtonsPerSpeed + kDragNewtonsPerSpeedSquared * place::lengthOf(vessel.velocity);
    constexpr float kSecondsPerKilogram = kTickSeconds / kVesselKilograms;
    vessel.velocity =
        (vessel.velocity + newtons * kSecondsPerKilogram) / (1 + drag * kSecondsPerKilogram);
}

float terminalSpeed(float newtons) {
    constexpr float a = kDragNewtonsPerSpeed;
    constexpr float b = kDragNewtonsPerSpeedSquared;
    return (std::sqrt(a * a + 4 * b * newtons) - a) / (2 * b);
}

}  // namespace aquarama::pilot
