// SPDX-License-Identifier: Apache-2.0
#include "master/fish/secondary_controller.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "common/base/digest.h"
#include "common/base/random_streams.h"
#include "common/base/units.h"
#include "common/motion/motor_tables.h"
#include "common/place/place.h"

namespace aquarama::fish {

Gaits gaitsOf(const motion::MotorTables& tables) {
    Gaits gaits;
    gaits.rows = tables.rows;
    for (std::size_t i = 0; i < motion::kActions; ++i) {
        const auto action = static_cast<motion::Action>(i);
        gaits.phaseRate[i] = motion::recordedPhaseRate(tables, action);
        gaits.speed[i] = motion::recordedSpeedBodyLengths(tables, action);
        gaits.yawRate[i] = motion::recordedTurnRate(tables, motion::firstSegmentOf(action));
        if (pitches(action)) gaits.pitchRate[i] = motion::recordedPitchRate(tables, action);
    }
    for (std::uint32_t segment = 0; segment < motion::kSegments; ++segment) {
        // A phase is 16 bits: 65536 steps are one cycle.
        const std::int16_t rate = gaits.phaseRate[indexOf(motion::actionOf(segment))];
        const float secondsOfCycle =
            65536.0F / (static_cast<float>(rate) * static_cast<float>(kTicksPerSecond));
        gaits.turn[segment] = motion::recordedTurnRate(tables, segment) * secondsOfCycle;
    }
    return gaits;
}

namespace {

// Yaw errors at which turns begin. A smaller one is corrected on a curve, and so is a larger one
// that the tight curve corrects within kCurveSeconds, unless there is danger. Beyond kSideIsOpen
// the target is nearly straight behind, and a turn under way keeps its side.
constexpr float kGradualFrom = 30.0F * kRadiansPerDegree<float>;
constexpr float kSharpFrom = 50.0F * kRadiansPerDegree<float>;
constexpr float kSharpFromInDanger = 45.0F * kRadiansPerDegree<float>;
constexpr float kSideIsOpen = 150.0F * kRadiansPerDegree<float>;
constexpr float kCurveSeconds = 2.0F;

// Yaw rate by yaw error, 1 / s. The error is that at the end of the next kLeadSeconds if the fish
// turns on as it does: the command before stands so long.
constexpr float kYawGain = 1.6F;
constexpr float kLeadSeconds =
    static_cast<float>(kTicksBetweenThoughts) / static_cast<float>(kTicksPerSecond);
// The yaw that is added to what a segment turns where that lacks more (MotorCommands::yawRate): all
// are shares of the rate of the tight curve of its gait. It lasts until less is lacking.
constexpr float kAdded = 0.4F;
constexpr float kAddedFrom = 0.6F;
constexpr float kAddedUntil = 0.3F;
// A hovering fish of a species that does not row is turned as it glides, radians a second.
constexpr float kMostHoverYaw = 15.0F * kRadiansPerDegree<float>;
// One that rows pivots from an error on, until a smaller one; errors that take it longer are left
// to a turn.
constexpr float kPivotFrom = 9.0F * kRadiansPerDegree<float>;
constexpr float kPivotUntil = 3.0F * kRadiansPerDegree<float>;
constexpr float kPivotSeconds = 8.0F;
// A curve is left for another where that is nearer to the wanted rate by this share of the tight
// curve's.
constexpr float kCurveHysteresis = 0.05F;
// A slope is swum rather than a curve where the pitch is off by more than this share of the
// heading.
constexpr float kSlopeFirst = 0.5F;
// Levels of a command. Within three quarters of a level the command before stands.
constexpr float kStay = 0.75F;
constexpr float kRateLevel = 1.0F / 32.0F;  // of the recorded phase rate
constexpr float kHoverYawLevel = 2.5F * kRadiansPerDegree<float>;
constexpr float kPitchLevel = 1.0F / 32.0F;  // of the sine
constexpr float kBrakeLevel = 1.0F / 8.0F;   // of full braking

constexpr float kUnitsOfPitchSine = 32768.0F;  // MotorCommands::pitch
// Limits of the phase rate: as shares of the recorded rate, and about the tempo of the fish.
constexpr float kRateMargin = 0.15F;
constexpr float kTempoMargin = 0.08F;
// Share of the difference between two gaits' speeds by which a speed must pass the border between
// them to change gait.
constexpr float kSpeedHysteresis = 0.15F;
// Braking begins when the fish is this much too fast, in body lengths a second, and is full at 1
// more.
constexpr float kBrakeFrom = 0.6F;
constexpr float kHoverBelow = 0.25F;  // of the slow gait's speed
// A hovering fish brakes fully from a quarter of a body length a second on.
constexpr float kHoverBrakeGain = 4.0F;
// A forward gait is kept for at least so long, unless there is danger.
constexpr std::uint64_t kShortestGaitTicks = 36;
// A fish makes a fast start at most so often, and does not brake for so long after it began one.
constexpr std::uint64_t kRecoveryTicks = 90;
constexpr std::uint64_t kBurstTicks = 60;
// How far a recommended segment may differ from the wanted speed and course.
constexpr float kSpeedMayDiffer = 0.9F;
constexpr float kCourseMayDiffer = 40.0F * kRadiansPerDegree<float>;
// A recommended gait is kept for 30 to 75 ticks.
constexpr std::uint32_t kShortestHoldTicks = 30, kHoldSpreadTicks = 46;

// A random number for one fish, stream and tick.
std::uint32_t drawn(std::uint32_t seed, std::size_t fish, Stream draw, std::uint64_t tick) {
    return hashOf(hashOf(hashOf(seed, static_cast<std::uint32_t>(fish)), draw),
                  static_cast<std::uint32_t>(tick));
}

// Uniform in 4 to 10 seconds: 240 to 600 ticks.
std::uint16_t patienceOf(std::uint32_t seed, std::size_t fish, std::uint64_t tick) {
    return static_cast<std::uint16_t>(240 + drawn(seed, fish, Stream::Patience, tick) % 361);
}

// One of the patterns that are recommended, other than the present one, each as likely. A curve or
// slope counts as its gait.
motion::Action otherThan(motion::Action present, std::uint32_t hash) {
    using motion::Action;
    constexpr std::array kPatterns{Action::ForwardSlow,
                                   Action::ForwardMedium,
                                   Action::ForwardFast,
                                   Action::TurnLeftGradual,
                                   Action::TurnLeftSharp,
                                   Action::TurnRightGradual,
                                   Action::TurnRightSharp,
                                   Action::Glide};
    const auto* const found = std::ranges::find(kPatterns, patternOf(present));
    const auto at = static_cast<std::size_t>(found - kPatterns.begin());
    return kPatterns[(at + 1 + hash % (kPatterns.size() - 1)) % kPatterns.size()];
}

motion::Action gradual(bool left) {
    return left ? motion::Action::TurnLeftGradual : motion::Action::TurnRightGradual;
}

motion::Action sharp(bool left) {
    return left ? motion::Action::TurnLeftSharp : motion::Action::TurnRightSharp;
}

// The forward gait whose speed is nearest, with hysteresis about the present gait.
motion::Action gaitFor(const Gaits& gaits, float speed, motion::Action present) {
    const auto isAbove = [&](std::size_t lower) {
        const float difference = gaits.speed[lower + 1] - gaits.speed[lower];
        const float border = gaits.speed[lower] + 0.5F * difference;
        const bool isUpper = swims(present) && gaitOf(present) > static_cast<motion::Action>(lower);
        return speed > border + (isUpper ? -kSpeedHysteresis : kSpeedHysteresis) * difference;
    };
    if (isAbove(indexOf(motion::Action::ForwardMedium))) return motion::Action::ForwardFast;
    return isAbove(indexOf(motion::Action::ForwardSlow)) ? motion::Action::ForwardMedium
                                                         : motion::Action::ForwardSlow;
}

}  // namespace

// The wishes and motion of one fish at its decision.
struct SecondaryController::Moment {
    // Segment that was commanded last.
    motion::Action present;
    // From the heading to the wanted course, radians, left positive.
    float yawError;
    // Sine of the wanted pitch less that of the present one.
    float pitchError;
    // Wanted and present speed, body lengths a second.
    float speed;
    float swims;
    // Course::urgency.
    float urgency;
    // Ticks since the present segment was chosen.
    std::uint64_t since;
    // Course::openToChange.
    bool isOpen;
};

namespace {

using Moment = SecondaryController::Moment;

// Whether the fish wants to stay in its place. It then glides, and its fins brake and turn it.
bool hovers(const Gaits& gaits, const Moment& moment) {
    return moment.speed < kHoverBelow * gaits.speed[indexOf(motion::Action::ForwardSlow)];
}

// The yaw rate of the tight curve at the gait of an action, radians a second.
float tightRateOf(const Gaits& gaits, motion::Action action) {
    return gaits.yawRate[indexOf(atGait(motion::Action::CurveLeftTightSlow, gaitOf(action)))];
}

// The yaw rate that the fish wants, radians a second: proportional to the error.
float wantedYaw(const Moment& moment) {
    return kYawGain * moment.yawError;
}

// Straight on, or the curve whose rate is nearest to the wanted one, with hysteresis about the
// present one.
motion::Action curveFor(const Gaits& gaits, const Moment& moment, motion::Action gait) {
    using motion::Action;
    constexpr std::array kWays{Action::ForwardSlow,
                               Action::CurveLeftWideSlow,
                               Action::CurveLeftTightSlow,
                               Action::CurveRightWideSlow,
                               Action::CurveRightTightSlow};
    const float wanted = wantedYaw(moment);
    const float advantage = kCurveHysteresis * tightRateOf(gaits, gait);
    const auto off = [&](Action slow) {
        const Action way = atGait(slow, gait);
        const float error = std::abs(wanted - gaits.yawRate[indexOf(way)]);
        return way == moment.present ? error - advantage : error;
    };
    return atGait(*std::ranges::min_element(kWays, {}, off), gait);
}

// A slope where the pitch is farther from the wanted one than the heading, else straight on or a
// curve.
motion::Action wayFor(const Gaits& gaits, const Moment& moment, motion::Action gait) {
    const float off = moment.pitchError;
    const bool slopes = motion::takesSlope(moment.present, off) &&
                        std::abs(off) > kSlopeFirst * std::abs(moment.yawError);
    return slopes ? motion::slopeOf(gait, off > 0) : curveFor(gaits, moment, gait);
}

// Whether a species rows: only then has it captured ways to stay in its place, and to back.
bool rows(const Gaits& gaits) {
    return gaits.rows[indexOf(motion::Action::Hover)];
}

motion::Action pivot(bool left) {
    return left ? motion::Action::PivotLeft : motion::Action::PivotRight;
}

// What a fish that rows does in its place.
motion::Action inPlaceFor(const Moment& moment) {
    using motion::Action;
    const float error = std::abs(moment.yawError);
    if (error > (isPivot(moment.present) ? kPivotUntil : kPivotFrom))
        return pivot(moment.yawError > 0);
    if (motion::takesSlope(moment.present, moment.pitchError))
        return moment.pitchError > 0 ? Action::PitchUp : Action::PitchDown;
    return Action::Hover;
}

// The segment for the wanted course, without recommendations. The order matters: a retreat, then
// staying in one place, then a sharp turn for a large error, then a gradual turn, then a gait.
motion::Action turnOrSwim(const Gaits& gaits, const Moment& moment) {
    const bool stays = hovers(gaits, moment) && moment.urgency < 1;
    if (moment.speed < 0) return rows(gaits) ? motion::Action::Retreat : motion::Action::Glide;
    const float error = std::abs(moment.yawError);
    const bool turning = isTurn(moment.present);
    const bool left = turning && error > kSideIsOpen ? isLeft(moment.present) : moment.yawError > 0;
    const motion::Action nearest = gaitFor(gaits, moment.speed, moment.present);
    const bool urgent = moment.urgency > 1;
    const bool turns = urgent || error > kCurveSeconds * tightRateOf(gaits, nearest);
    const float pivotRate = gaits.yawRate[indexOf(motion::Action::PivotLeft)];
    const bool pivots = rows(gaits) && moment.urgency < 1 && error < kPivotSeconds * pivotRate;
    if (stays && pivots) return inPlaceFor(moment);
    if (turns && pivots && moment.urgency == 0 && gaits.rows[indexOf(nearest)])
        return pivot(moment.yawError > 0);
    if (turns && error > (urgent ? kSharpFromInDanger : kSharpFrom)) return sharp(left);
    if (stays && rows(gaits)) return inPlaceFor(moment);
    if (stays) return motion::Action::Glide;
    if (turns && error > kGradualFrom) return gradual(left);
    const bool tooSoon =
        swims(moment.present) && moment.since < kShortestGaitTicks && moment.urgency < 1;
    return wayFor(gaits, moment, tooSoon ? gaitOf(moment.present) : nearest);
}

// The level nearest to `wanted`, or `present` where that is near enough.
float levelFor(float wanted, float present, float level) {
    if (std::abs(wanted - present) <= kStay * level) return present;
    return std::round(wanted / level) * level;
}

// The yaw added to that of the chosen segment, in units of MotorCommands::yawRate. A hovering fish
// that does not row is turned as it needs; another one by kAdded or not at all.
std::int16_t yawRateFor(const Gaits& gaits,
                        const Moment& moment,
                        motion::Action chosen,
                        std::int16_t present) {
    constexpr float kUnit = motion::kYawUnit * static_cast<float>(kTicksPerSecond);
    if (staysInPlace(chosen)) return 0;
    const float lacks = wantedYaw(moment) - gaits.yawRate[indexOf(chosen)];
    if (chosen == motion::Action::Glide) {
        const float level = levelFor(std::clamp(lacks, -kMostHoverYaw, kMostHoverYaw),
                                     static_cast<float>(present) * kUnit,
                                     kHoverYawLevel);
        return static_cast<std::int16_t>(level / kUnit);
    }
    const float tight = tightRateOf(gaits, chosen);
    if (std::abs(lacks) < (present == 0 ? kAddedFrom : kAddedUntil) * tight) return 0;
    return static_cast<std::int16_t>(std::copysign(kAdded * tight, lacks) / kUnit);
}

// Share of full braking, 0 to 255, by how much the fish is too fast.
std::uint8_t brakeFor(const Gaits& gaits,
                      const Moment& moment,
                      motion::Action chosen,
                      std::uint8_t present) {
    const bool stays = hovers(gaits, moment);
    const float excess = moment.swims - (staysInPlace(chosen) && !stays ? 0 : moment.speed);
    const float share =
        stays || staysInPlace(chosen) ? excess * kHoverBrakeGain : excess - kBrakeFrom;
    const float level =
        levelFor(std::clamp(share, 0.0F, 1.0F), static_cast<float>(present) / 255.0F, kBrakeLevel);
    return static_cast<std::uint8_t>(255 * level);
}

// The present pattern, on the way that the course asks for now.
motion::Action held(const Gaits& gaits, const Moment& moment) {
    return swims(moment.present) ? wayFor(gaits, moment, gaitOf(moment.present)) : moment.present;
}

// Whether a recommended segment keeps roughly to the wanted course and speed. Sharp turns never do.
bool serves(const Gaits& gaits, const Moment& moment, motion::Action recommended) {
    if (isSharp(recommended)) return false;
    if (isTurn(recommended))
        return std::abs(moment.yawError - gaits.turn[firstSegmentOf(recommended)]) <
               kCourseMayDiffer;
    if (std::abs(moment.yawError) > kGradualFrom) return false;
    return recommended == motion::Action::Glide
               ? moment.swims > moment.speed
               : std::abs(gaits.speed[indexOf(recommended)] - moment.speed) < kSpeedMayDiffer;
}

}  // namespace

void ControllerMemory::resize(std::size_t fish) {
    chosenAt.resize(fish);
    heldUntil.resize(fish);
    patience.resize(fish);
    recoversAt.resize(fish);
}

std::size_t ControllerMemory::bytes() const {
    return bytesIn(chosenAt, heldUntil, patience, recoversAt);
}

float tempoOf(std::uint32_t seed, std::size_t fish) {
    return 1 + 0.1F * signedUnitOf(drawn(seed, fish, Stream::Tempo, 0));
}

void startCommands(const Gaits& gaits,
                   std::uint32_t seed,
                   std::size_t first,
                   std::size_t last,
                   motion::MotorCommands& commands,
                   ControllerMemory& memory) {
    assert(first <= last);
    assert(last <= commands.action.size());
    for (std::size_t fish = first; fish < last; ++fish) {
        commands.action[fish] = static_cast<std::uint8_t>(motion::Action::ForwardMedium);
        commands.phaseRate[fish] = gaits.phaseRate[indexOf(motion::Action::ForwardMedium)];
        commands.pitch[fish] = 0;
        commands.yawRate[fish] = 0;
        commands.brake[fish] = 0;
        commands.mouth[fish] = 0;
        commands.gaze[fish] = 0;
        memory.chosenAt[fish] = 0;
        memory.heldUntil[fish] = 0;
        memory.recoversAt[fish] = 0;
        memory.patience[fish] = patienceOf(seed, fish, 0);
    }
}

void SecondaryController::run(std::size_t first, std::size_t last) const {
    assert(gaits != nullptr);
    assert(view != nullptr);
    assert(courses != nullptr);
    assert(states != nullptr);
    assert(thought != nullptr);
    assert(commands != nullptr);
    assert(memory != nullptr);
    assert(first <= last);
    assert(last <= courses->size());
    assert(last <= states->size());
    for (std::size_t fish = first; fish < last; ++fish) {
        const bool hasThought = std::exchange((*thought)[fish], 0) != 0;
        if (hasThought) {
            commands->mouth[fish] = (*courses)[fish].face.mouth;
            commands->gaze[fish] = (*courses)[fish].face.gaze;
        }
        if ((hasThought && (thinksAt(tick, fish) || mayStart(fish))) || endsTurn(fish))
            decide(fish);
    }
}

bool SecondaryController::endsTurn(std::size_t fish) const {
    const motion::Action playing = motion::actionOf(states->segment[fish]);
    if (motion::entriesOf(playing) == 0) return false;  // one number is read of most fish
    // The motor plays the turn at the commanded rate if the turn is still commanded, else at the
    // recorded rate.
    const bool goesOn = static_cast<motion::Action>(commands->action[fish]) == playing;
    const int rate = goesOn ? commands->phaseRate[fish] : gaits->phaseRate[indexOf(playing)];
    return states->phase[fish] + rate > motion::lastPhaseOf(playing);
}

void SecondaryController::decide(std::size_t fish) const {
    const Moment moment = momentOf(fish);
    const motion::Action asked = choose(fish, moment);
    const motion::Action chosen = isKept(fish, moment, asked) ? moment.present : asked;
    if (patternOf(chosen) != patternOf(moment.present)) memory->chosenAt[fish] = tick.value;
    motion::MotorCommands& to = *commands;
    to.phaseRate[fish] = phaseRateFor(fish, chosen, moment);
    to.action[fish] = static_cast<std::uint8_t>(chosen);
    to.pitch[fish] = static_cast<std::int16_t>(
        std::clamp(levelFor((*courses)[fish].direction.y,
                            static_cast<float>(to.pitch[fish]) / kUnitsOfPitchSine,
                            kPitchLevel) *
                       kUnitsOfPitchSine,
                   -32767.0F,
                   32767.0F));
    const bool steers = !isTurn(chosen) && !isStart(chosen);
    to.yawRate[fish] =
        steers ? yawRateFor(*gaits, moment, chosen, to.yawRate[fish]) : std::int16_t{0};
    // A fish that has made a fast start coasts, but not into danger.
    const bool coasts = isBursting(fish) && moment.urgency <= 1;
    to.brake[fish] =
        steers && !coasts ? brakeFor(*gaits, moment, chosen, to.brake[fish]) : std::uint8_t{0};
}

bool SecondaryController::isKept(std::size_t fish,
                                 const Moment& moment,
                                 motion::Action asked) const {
    const motion::Action playing = motion::actionOf(states->segment[fish]);
    return moment.urgency > 0 && isTurn(playing) && !isStart(asked) && !endsTurn(fish) &&
           motion::breaksOff(playing, asked);
}

SecondaryController::Moment SecondaryController::momentOf(std::size_t fish) const {
    const Course& course = (*courses)[fish];
    const glm::vec3 heading = view->heading(fish);
    Moment moment{static_cast<motion::Action>(commands->action[fish]),
                  place::yawBetween(heading, course.direction),
                  course.direction.y - heading.y,
                  course.speed,
                  motion::speedBodyLengths(*states, fish),
                  course.urgency,
                  tick.value - memory->chosenAt[fish],
                  course.openToChange};
    // A turn will be played to its end, unless a turn to the other side is chosen: what is chosen
    // comes after it.
    const std::uint16_t playing = states->segment[fish];
    const motion::Action action = motion::actionOf(playing);
    // It plays during the warp that leads to its phase.
    const bool warps = states->warpFrame[fish] != states->warpLength[fish];
    const float warped = warps ? static_cast<float>(states->warpFrame[fish] + 1) /
                                     static_cast<float>(states->warpLength[fish] + 1)
                               : 1.0F;
    const float toCome = 1 - warped * static_cast<float>(states->phase[fish]) / 65536.0F;
    moment.yawError -= motion::entriesOf(action) > 0
                           ? gaits->turn[playing] * toCome
                           : gaits->yawRate[indexOf(action)] * kLeadSeconds;
    moment.pitchError -= gaits->pitchRate[indexOf(action)] * kLeadSeconds;
    return moment;
}

// Recommendation (paper, section 5.1): after `patience` ticks of one segment another is drawn, and
// taken if the course is open to it and it serves. A gait is then held for a while; a turn is
// played to its end anyway. Without recommendations this is turnOrSwim().
motion::Action SecondaryController::choose(std::size_t fish, const Moment& moment) const {
    if (const auto start = startFor(fish)) return *start;
    const motion::Action chosen = turnOrSwim(*gaits, moment);
    if (tick.value < memory->heldUntil[fish])
        return moment.isOpen && !isSharp(chosen) ? held(*gaits, moment) : chosen;
    if (patternOf(chosen) != patternOf(moment.present) || moment.since <= memory->patience[fish])
        return chosen;
    memory->chosenAt[fish] = tick.value;
    memory->patience[fish] = patienceOf(seed, fish, tick.value);
    const motion::Action recommended =
        otherThan(moment.present, drawn(seed, fish, Stream::RecommendedGait, tick.value));
    if (!moment.isOpen || !serves(*gaits, moment, recommended)) return chosen;
    if (isTurn(recommended)) return recommended;  // it holds by itself
    memory->heldUntil[fish] = tick.value + kShortestHoldTicks +
                              drawn(seed, fish, Stream::GaitHold, tick.value) % kHoldSpreadTicks;
    return recommended;
}

// The fast start whose turn is nearest to the wanted one. After it the fish swims on as it asks; a
// course that hardly differs asks for none.
std::optional<motion::Action> SecondaryController::startFor(std::size_t fish) const {
    using motion::Action;
    if (!mayStart(fish)) return std::nullopt;
    // It breaks off a turn, so nothing of that is to come.
    const float yawError = place::yawBetween(view->heading(fish), (*courses)[fish].direction);
    const auto first = indexOf(yawError > 0 ? Action::StartLeftSmall : Action::StartRightSmall);
    const float wanted = std::abs(yawError);
    const auto off = [&](std::size_t size) {
        const auto start = static_cast<Action>(first + size);
        return std::abs(std::abs(gaits->turn[motion::firstSegmentOf(start)]) - wanted);
    };
    std::size_t nearest = 0;
    for (std::size_t size = 1; size < motion::kStarts / 2; ++size)
        if (off(size) < off(nearest)) nearest = size;
    if (wanted < off(nearest)) return std::nullopt;  // straight on is nearer
    memory->recoversAt[fish] = tick.value + kRecoveryTicks;
    return static_cast<Action>(first + nearest);
}

bool SecondaryController::mayStart(std::size_t fish) const {
    return (*courses)[fish].startsFast && tick.value >= memory->recoversAt[fish];
}

bool SecondaryController::isBursting(std::size_t fish) const {
    return memory->recoversAt[fish] > tick.value + kRecoveryTicks - kBurstTicks;
}

// A gait is played faster or slower to reach the wanted speed, and a turn in danger faster; the
// rate stays within kRateMargin of the recording and kTempoMargin of the fish's own tempo.
std::int16_t SecondaryController::phaseRateFor(std::size_t fish,
                                               motion::Action chosen,
                                               const Moment& moment) const {
    const std::size_t action = indexOf(chosen);
    const auto recorded = static_cast<float>(gaits->phaseRate[action]);
    const float tempo = tempoOf(seed, fish);
    const float least = std::max(1 - kRateMargin, tempo - kTempoMargin);
    const float most = std::min(1 + kRateMargin, tempo + kTempoMargin);
    if (isStart(chosen)) return gaits->phaseRate[action];
    const float turns = moment.urgency > 1 ? most : tempo;
    const float rate = swims(chosen) ? moment.speed / gaits->speed[action] : turns;
    const float present =
        chosen == moment.present ? static_cast<float>(commands->phaseRate[fish]) / recorded : 0.0F;
    const float level = levelFor(std::clamp(rate, least, most), present, kRateLevel);
    return static_cast<std::int16_t>(std::lround(recorded * std::clamp(level, least, most)));
}

}  // namespace aquarama::fish
