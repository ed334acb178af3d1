// SPDX-License-Identifier: Apache-2.0
#include "master/motor/secondary_controller.h"

#include <algorithm>
#include <optional>

#include "common/place/noise.h"
#include "master/behaviour/angle.h"

namespace aquarama {

namespace {

// Streams of one seed: what a number is drawn for.
enum Draw : std::uint32_t { kTempo = 101, kPatience, kRecommended, kHold };

constexpr float kGradualFrom = 18.0F * kRadiansPerDegree;  // error at which a turn begins
constexpr float kGradualTo = 6.0F * kRadiansPerDegree;     // and at which it ends
constexpr float kSharpFrom = 85.0F * kRadiansPerDegree;
constexpr float kSharpFromInDanger = 45.0F * kRadiansPerDegree;
constexpr float kSideIsOpen = 150.0F * kRadiansPerDegree;  // beyond, either side serves

constexpr float kYawGain = 1.6F;                             // radians a second for a radian
constexpr float kMostYaw = 30.0F * kRadiansPerDegree;        // a second: beyond, a turn is played
constexpr float kRadiansOfYawUnit = 1.0F / (1 << 20);        // MotorCommands::yawRate
constexpr float kUnitsOfPitchSine = 32768.0F;                // MotorCommands::pitch
constexpr float kRateMargin = 0.15F;                         // of the recorded phase rate
constexpr float kTempoMargin = 0.08F;                        // about a fish's own tempo
constexpr float kSpeedHysteresis = 0.12F;                    // body lengths a second
constexpr std::uint64_t kShortestGaitTicks = 36;
constexpr float kSpeedMayDiffer = 0.9F;   // of a recommended gait, body lengths a second
constexpr float kCourseMayDiffer = 40.0F * kRadiansPerDegree;
constexpr float kCalm = 0.15F;  // urgency up to which a recommendation is considered

std::uint32_t drawn(std::uint32_t seed, std::size_t fish, Draw draw, std::uint64_t tick) {
    return hashOf(hashOf(hashOf(seed, static_cast<std::uint32_t>(fish)), draw),
                  static_cast<std::uint32_t>(tick));
}

// U(4, 10) seconds.
std::uint16_t patienceOf(std::uint32_t seed, std::size_t fish, std::uint64_t tick) {
    return static_cast<std::uint16_t>(240 + drawn(seed, fish, kPatience, tick) % 361);
}

Action gradual(bool left) {
    return left ? Action::TurnLeftGradual : Action::TurnRightGradual;
}

Action sharp(bool left) {
    return left ? Action::TurnLeftSharp : Action::TurnRightSharp;
}

Action gaitFor(const Gaits& gaits, float speed, Action present) {
    const float slowToMedium = 0.5F * (gaits.speed[0] + gaits.speed[1]);
    const float mediumToFast = 0.5F * (gaits.speed[1] + gaits.speed[2]);
    const auto isAbove = [&](float border, Action upper) {
        const bool isUpper = isForward(present) && present >= upper;
        return speed > border + (isUpper ? -kSpeedHysteresis : kSpeedHysteresis);
    };
    if (isAbove(mediumToFast, Action::ForwardFast)) return Action::ForwardFast;
    return isAbove(slowToMedium, Action::ForwardMedium) ? Action::ForwardMedium
                                                        : Action::ForwardSlow;
}

// The situation of one fish at its decision.
struct Moment {
    Action present;      // segment that was asked for last
    float yawError;      // radians, left positive
    float speed;         // wanted, body lengths a second
    float urgency;
    std::uint64_t since;  // ticks that the present segment has been pursued
};

Action turnOrSwim(const Gaits& gaits, const Moment& moment) {
    const float error = std::abs(moment.yawError);
    const bool turning = !isForward(moment.present);
    const bool left = turning && error > kSideIsOpen ? isLeft(moment.present)
                                                     : moment.yawError > 0;
    if (error > (moment.urgency > 1 ? kSharpFromInDanger : kSharpFrom)) return sharp(left);
    const bool sameTurn = turning && isLeft(moment.present) == left;
    if (error > (sameTurn ? kGradualTo : kGradualFrom)) return gradual(left);
    const Action gait = gaitFor(gaits, moment.speed, moment.present);
    const bool tooSoon = !turning && moment.since < kShortestGaitTicks && moment.urgency < 1;
    return tooSoon ? moment.present : gait;
}

// The intention generator's word on a recommendation.
bool accepts(const Gaits& gaits, const Moment& moment, Action recommended) {
    if (moment.urgency > kCalm || isSharp(recommended)) return false;
    if (isForward(recommended))
        return std::abs(moment.yawError) < kGradualFrom &&
               std::abs(gaits.speed[indexOf(recommended)] - moment.speed) < kSpeedMayDiffer;
    const float left = isLeft(recommended) ? 1.0F : -1.0F;
    const float after = moment.yawError - left * 0.5F * kCourseMayDiffer;
    return std::abs(after) < kCourseMayDiffer;
}

}  // namespace

void ControllerMemory::resize(std::size_t fish) {
    chosenAt.resize(fish);
    heldUntil.resize(fish);
    patience.resize(fish);
}

float tempoOf(std::uint32_t seed, std::size_t fish) {
    return 1 + 0.1F * signedUnitOf(drawn(seed, fish, kTempo, 0));
}

void startCommands(const Gaits& gaits,
                   std::uint32_t seed,
                   MotorCommands& commands,
                   ControllerMemory& memory) {
    for (std::size_t fish = 0; fish < commands.segment.size(); ++fish) {
        commands.segment[fish] = static_cast<std::uint8_t>(Action::ForwardMedium);
        commands.phaseRate[fish] = gaits.phaseRate[indexOf(Action::ForwardMedium)];
        commands.pitch[fish] = 0;
        commands.yawRate[fish] = 0;
        memory.chosenAt[fish] = 0;
        memory.heldUntil[fish] = 0;
        memory.patience[fish] = patienceOf(seed, fish, 0);
    }
}

void SecondaryController::run(std::size_t first, std::size_t last) const {
    for (std::size_t fish = first; fish < last; ++fish)
        if (thinksAt(tick, fish)) decide(fish);
}

void SecondaryController::decide(std::size_t fish) const {
    const auto present = static_cast<Action>(commands->segment[fish]);
    const glm::vec3 wanted = intentions->direction(fish);
    Moment moment{present,
                  yawBetween(view->heading(fish), wanted),
                  intentions->speed[fish],
                  intentions->urgency[fish],
                  tick.value - memory->chosenAt[fish]};
    // A sharp turn that plays now will be played to its end: what is chosen comes after it.
    const auto playing = static_cast<Action>(states->segment[fish]);
    if (isSharp(playing)) {
        const float toCome = 1 - static_cast<float>(states->phase[fish]) / 65536.0F;
        moment.yawError -= gaits->turnOfCycle[indexOf(playing)] * toCome;
    }

    Action chosen = turnOrSwim(*gaits, moment);
    const bool following = tick.value < memory->heldUntil[fish];
    if (following && moment.urgency < 1 && !isSharp(chosen)) chosen = present;
    if (!following && moment.since > memory->patience[fish] && chosen == present) {
        const auto recommended = static_cast<Action>(
            drawn(seed, fish, kRecommended, tick.value) % static_cast<std::uint32_t>(kActions));
        if (accepts(*gaits, moment, recommended)) {
            chosen = recommended;
            memory->heldUntil[fish] = tick.value + 30 + drawn(seed, fish, kHold, tick.value) % 46;
        }
        memory->chosenAt[fish] = tick.value;
        memory->patience[fish] = patienceOf(seed, fish, tick.value);
    }
    if (chosen != present) memory->chosenAt[fish] = tick.value;

    const std::size_t action = indexOf(chosen);
    const float tempo = tempoOf(seed, fish);
    const float stretch = isForward(chosen) ? moment.speed / gaits->speed[action] : tempo;
    const float rate = std::clamp(stretch,
                                  std::max(1 - kRateMargin, tempo - kTempoMargin),
                                  std::min(1 + kRateMargin, tempo + kTempoMargin));
    commands->segment[fish] = static_cast<std::uint8_t>(chosen);
    commands->phaseRate[fish] =
        static_cast<std::uint16_t>(static_cast<float>(gaits->phaseRate[action]) * rate);
    commands->pitch[fish] = static_cast<std::int16_t>(wanted.y * kUnitsOfPitchSine);
    const float yaw = isForward(chosen)
                          ? std::clamp(kYawGain * moment.yawError, -kMostYaw, kMostYaw)
                          : 0.0F;
    commands->yawRate[fish] = static_cast<std::int16_t>(
        yaw / static_cast<float>(kTicksPerSecond) / kRadiansOfYawUnit);
}

}  // namespace aquarama
