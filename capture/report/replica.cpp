// SPDX-License-Identifier: Apache-2.0
#include "capture/report/replica.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include <glm/gtc/quaternion.hpp>

#include "capture/report/script.h"
#include "capture/speed_response.h"
#include "capture/turn.h"
#include "common/base/units.h"
#include "common/motion/reconstruct.h"
#include "common/motion/repertoire.h"

namespace aquarama::report {

namespace {

// The replica.

constexpr std::array kTraits{motion::FishTraits{.id = 0, .lengthMillimetres = 1000}};

// Radians, up positive; 0 where the fish keeps level.
double pitchOf(Manoeuvre manoeuvre) {
    return manoeuvre == Manoeuvre::Ascend    ? kScriptPitchRadians
           : manoeuvre == Manoeuvre::Descend ? -kScriptPitchRadians
                                             : 0;
}

// The phase, in units of 1/65536 of a cycle, whose pose has the least sum of squared distances of
// the nodal points. It tries kFiner phases for each recorded one.
std::uint16_t nearestPhase(const motion::ActionSegment& segment, const capture::NodeVectors& pose) {
    constexpr int kFiner = 4;
    std::uint16_t nearest = 0;
    double least = std::numeric_limits<double>::max();
    for (int i = 0; i < kFiner * motion::kPhases; ++i) {
        const motion::PhaseSample sample =
            motion::sampleAt(static_cast<float>(i) / (kFiner * motion::kPhases));
        double sum = 0;
        for (std::size_t node = 0; node < pose.size(); ++node) {
            const auto at = [&](std::size_t k) {
                const auto& point = segment.nodes[k][node];
                return glm::dvec3(point[0], point[1], point[2]) *
                       static_cast<double>(motion::kPoseUnit);
            };
            const glm::dvec3 off =
                glm::mix(at(sample.before), at(sample.after), static_cast<double>(sample.share)) -
                pose[node];
            sum += glm::dot(off, off);
        }
        if (sum >= least) continue;
        least = sum;
        nearest = static_cast<std::uint16_t>(i * (65536 / (kFiner * motion::kPhases)));
    }
    return nearest;
}

}  // namespace

Replica::Replica(const motion::Repertoire& repertoire)
    : repertoire_(repertoire), tables_(motion::makeMotorTables(repertoire)) {
    // One fish, in steady medium swimming.
    states_.resize(1);
    commands_.resize(1);
    motion::setBodyFrame(states_, 0, {});
    states_.segment[0] = motion::firstSegmentOf(motion::Action::ForwardMedium);
    motion::setSpeedBodyLengths(
        states_, 0, motion::recordedSpeedBodyLengths(*tables_, motion::Action::ForwardMedium));
}

// The motor takes the brake as 0 to 255 and the pitch as its sine in units of 1/32768.
void Replica::command(Manoeuvre manoeuvre) {
    play(actionOf(manoeuvre), 1);
    commands_.brake[0] = manoeuvre == Manoeuvre::Brake ? 255 : 0;
    commands_.pitch[0] =
        static_cast<std::int16_t>(std::lround(std::sin(pitchOf(manoeuvre)) * 32768));
}

void Replica::play(motion::Action action, double tempo) {
    wanted_ = action;
    begin(action, tempo);
}

void Replica::begin(motion::Action action, double tempo) {
    commands_.action[0] = static_cast<std::uint8_t>(action);
    const auto rate = std::lround(tempo * motion::recordedPhaseRate(*tables_, action));
    assert(rate >= std::numeric_limits<std::int16_t>::min());
    assert(rate <= std::numeric_limits<std::int16_t>::max());
    commands_.phaseRate[0] = static_cast<std::int16_t>(rate);
}

float Replica::pitchSine() const {
    return (motion::meanRotation(*tables_, states_, 0) * glm::vec3(1, 0, 0)).y;
}

// As the secondary controller of the show does: a slope while the pitch is off.
void Replica::takeSlope() {
    const float error = static_cast<float>(commands_.pitch[0]) / 32768.0F - pitchSine();
    const auto present = static_cast<motion::Action>(commands_.action[0]);
    begin(
        motion::takesSlope(present, error) ? motion::slopeOf(gaitOf(wanted_), error > 0) : wanted_,
        1);
}

// The fins of a fish that pitches up go on as long as they are told: nothing is steered.
void Replica::pitchInPlace() {
    const float pitch = pitchSine();
    if (wanted_ == motion::Action::PitchUp) {
        commands_.pitch[0] = static_cast<std::int16_t>(std::lround(pitch * 32767));
        return;
    }
    const auto present = static_cast<motion::Action>(commands_.action[0]);
    if (motion::takesSlope(present, -pitch))
        begin(pitch > 0 ? motion::Action::PitchDown : motion::Action::PitchUp, 1);
    else
        begin(wanted_, 1);
}

void Replica::tick() {
    if (swims(wanted_)) takeSlope();
    if (staysInPlace(wanted_)) pitchInPlace();
    motion::MotorStep{.tables = tables_.get(),
                      .traits = kTraits,
                      .commands = &commands_,
                      .states = &states_,
                      .first = 0,
                      .last = 1}
        .run();
}

void Replica::learn(motion::Action action, const motion::ActionSegment& segment) {
    assert(action != playing());
    repertoire_.segments.at(static_cast<std::size_t>(action)) = segment;
    tables_ = motion::makeMotorTables(repertoire_);
}

void Replica::bringToPhaseOf(const capture::NodeVectors& pose) {
    const motion::ActionSegment& segment = repertoire_.segments.at(indexOf(playing()));
    const bool warps = states_.warpFrame[0] != states_.warpLength[0];
    if (warps || segment.playsToEnd || playing() == motion::Action::Glide) return;
    // A jump of the phase would turn the mean frame by the sway between the two phases; the body
    // frame is turned back by as much.
    const glm::quat course = motion::meanRotation(*tables_, states_, 0);
    states_.phase[0] = nearestPhase(segment, pose);
    const glm::quat shifted = motion::meanRotation(*tables_, states_, 0);
    motion::BodyFrame frame = motion::bodyFrameOf(states_, 0);
    frame.rotation = course * glm::conjugate(shifted) * frame.rotation;
    motion::setBodyFrame(states_, 0, frame);
}

// Through the record and the reconstruction that a render node uses, so that the error of both is
// part of what is measured.
TracePoint Replica::point() const {
    const motion::FishRecord record = motion::recordOf(states_, 0);
    body::NodalPoints nodes;
    const motion::PresentedFish fish = motion::present(record, record, 1.0F, kTraits[0]);
    motion::nodalPose(repertoire_, fish, nodes);
    const motion::BodyFrame frame = motion::bodyFrameOf(record);
    TracePoint point{.frame = {glm::dvec3(frame.position),
                               glm::mat3_cast(glm::normalize(glm::dquat(frame.rotation)))}};
    for (std::size_t i = 0; i < nodes.size(); ++i) point.pose.at(i) = nodes.at(i);
    const auto [left, right] = motion::finPoses(repertoire_, fish);
    point.drive = {.speed = fish.speed,
                   .tilt = static_cast<float>(point.frame.worldFromBody[2].y),
                   .spread = fish.spread,
                   .left = left,
                   .right = right,
                   .phase = fish.phase,
                   .fromPhase = fish.fromPhase,
                   .weight = fish.warpWeight};
    return point;
}

namespace {

// The biomechanical fish.

// The fish's own seconds from rest until it swims steadily at medium speed.
constexpr double kSecondsToSteady = 24;

// A curve to the left as one to the right.
capture::Order mirrored(capture::Order curve) {
    curve.curve = -curve.curve;
    curve.bankRadians = -curve.bankRadians;
    return curve;
}

// A swimming fish balances, since the replica always does (the paper's section 4.2). The fins have
// no effect on a fish that is level and upright already.
capture::Order orderFor(const config::Species& species, Manoeuvre manoeuvre) {
    const config::Swim& swim = species.swim;
    switch (manoeuvre) {
        case Manoeuvre::ForwardSlow:
            return {.controller = capture::Controller::Balance, .gait = swim.slow};
        case Manoeuvre::ForwardMedium:
        case Manoeuvre::Balance:
            return {.controller = capture::Controller::Balance, .gait = swim.medium};
        case Manoeuvre::ForwardFast:
            return {.controller = capture::Controller::Balance, .gait = swim.fast};
        case Manoeuvre::TurnLeftGradual:
            return {.controller = capture::Controller::LeftTurn,
                    .bend = species.turn.gradual,
                    .bankRadians = capture::kBankRadians};
        case Manoeuvre::TurnLeftSharp:
            return {.controller = capture::Controller::LeftTurn,
                    .bend = species.turn.sharp,
                    .bankRadians = capture::kBankRadians};
        case Manoeuvre::TurnRightGradual:
            return {.controller = capture::Controller::RightTurn,
                    .bend = species.turn.gradual,
                    .bankRadians = capture::kBankRadians};
        case Manoeuvre::TurnRightSharp:
            return {.controller = capture::Controller::RightTurn,
                    .bend = species.turn.sharp,
                    .bankRadians = capture::kBankRadians};
        case Manoeuvre::Glide:
            return {.controller = capture::Controller::Glide};
        case Manoeuvre::Ascend:
            return {.controller = capture::Controller::Ascend,
                    .gait = swim.medium,
                    .pitchRadians = kScriptPitchRadians};
        case Manoeuvre::Descend:
            return {.controller = capture::Controller::Descend,
                    .gait = swim.medium,
                    .pitchRadians = kScriptPitchRadians};
        case Manoeuvre::Brake:
            return {.controller = capture::Controller::Brake};
        case Manoeuvre::Retreat:
            return capture::rowingOrder(species, capture::Controller::Retreat);
        case Manoeuvre::CurveLeft:
            return capture::tightCurve(swim.medium);
        case Manoeuvre::CurveRight:
            return mirrored(capture::tightCurve(swim.medium));
        case Manoeuvre::Hover:
            return capture::rowingOrder(species, capture::Controller::Hover);
        case Manoeuvre::PivotLeft:
            return capture::rowingOrder(species, capture::Controller::LeftPivot);
        case Manoeuvre::PitchUp:
            return capture::rowingOrder(species, capture::Controller::PitchUp);
        default:
            break;
    }
    const auto size =
        static_cast<std::size_t>(manoeuvre) - static_cast<std::size_t>(Manoeuvre::StartLeftSmall);
    const bool left = size < capture::kBendShares.size();
    return {.controller = left ? capture::Controller::LeftStart : capture::Controller::RightStart,
            .bendShare = capture::kBendShares.at(size % capture::kBendShares.size())};
}

// Turns and fast starts, of which a replica has a segment from their begin to their end.
bool playsOnce(capture::Controller controller) {
    using capture::Controller;
    return controller == Controller::LeftTurn || controller == Controller::RightTurn ||
           controller == Controller::LeftStart || controller == Controller::RightStart;
}

// A pectoral fin as it is drawn.
body::FinPose finPoseOf(const glm::dvec3& fin) {
    return {static_cast<float>(fin.x), static_cast<float>(fin.y), static_cast<float>(fin.z)};
}

// A point of a trace. `spread`: how far the pectoral fins brake, as the motor has it.
TracePoint tracePointOf(const capture::Swimmer& swimmer, float spread) {
    const capture::NodeVectors& pose = swimmer.state().positions;
    TracePoint point{.frame = capture::frameOf(pose), .pose = capture::inBodyFrame(pose)};
    glm::dvec3 velocity{};
    for (const glm::dvec3& node : swimmer.state().velocities)
        velocity += node / static_cast<double>(body::kNodalPoints);
    const auto [left, right] = swimmer.fins();
    point.drive = {.speed = static_cast<float>(dot(velocity, point.frame.worldFromBody[0])),
                   .tilt = static_cast<float>(point.frame.worldFromBody[2].y),
                   .spread = spread,
                   .left = finPoseOf(left),
                   .right = finPoseOf(right),
                   .phase = static_cast<float>(swimmer.beat())};
    return point;
}

}  // namespace

// A tick has a whole number of steps, none longer than longestStepSeconds().
Trace traceFish(const config::Species& species, std::span<const TimedOrder> orders) {
    const double longest = capture::longestStepSeconds(capture::makeBiomechanicalFish(species));
    const int stepsPerTick = static_cast<int>(std::ceil(1 / (kTicksPerSecond * longest) - 1e-9));
    capture::Swimmer swimmer(species, 1 / (kTicksPerSecond * stepsPerTick));

    swimmer.give(orderFor(species, Manoeuvre::ForwardMedium));
    const double beatSeconds = 1 / species.swim.medium.beatHertz;
    const double beats = std::ceil(kSecondsToSteady / species.tissue.timeScale / beatSeconds);
    swimmer.advance(static_cast<int>(std::lround(beats * beatSeconds / swimmer.stepSeconds())));

    float spread = 0;
    Trace trace{tracePointOf(swimmer, spread)};
    for (const auto& [order, ticks] : orders) {
        swimmer.give(order);
        const float wanted = order.controller == capture::Controller::Brake ? 1 : 0;
        for (int tick = 0; tick < ticks; ++tick) {
            swimmer.advance(stepsPerTick);
            constexpr float kStep = motion::kSpreadStep / 255.0F;
            spread += std::clamp(wanted - spread, -kStep, kStep);
            trace.push_back(tracePointOf(swimmer, spread));
            if (playsOnce(order.controller))
                trace.back().drive.phase = static_cast<float>(tick + 1) / static_cast<float>(ticks);
        }
    }
    return trace;
}

// The orders of a script, its run-in included.
Trace traceFish(const config::Species& species, const Script& script) {
    std::vector<TimedOrder> orders;
    for (const ScriptCommand& command : script)
        orders.push_back({orderFor(species, command.manoeuvre), command.ticks});
    return traceFish(species, orders);
}

namespace {

// Runs a replica through the script and calls beforeCommand(replica, tick) before each command,
// where `tick` is the index of the last point.
template <class Before>
Trace traceOf(const motion::Repertoire& repertoire, const Script& script, Before beforeCommand) {
    Replica replica(repertoire);
    Trace trace{replica.point()};
    for (const ScriptCommand& command : script) {
        beforeCommand(replica, trace.size() - 1);
        replica.command(command.manoeuvre);
        for (int tick = 0; tick < command.ticks; ++tick) {
            replica.tick();
            trace.push_back(replica.point());
        }
    }
    return trace;
}

}  // namespace

Trace traceReplica(const motion::Repertoire& repertoire, const Script& script) {
    return traceOf(repertoire, script, [](Replica&, std::size_t) {});
}

Trace traceReplicaInPhase(const motion::Repertoire& repertoire,
                          const Script& script,
                          const Trace& fish) {
    return traceOf(repertoire, script, [&](Replica& replica, std::size_t tick) {
        replica.bringToPhaseOf(fish.at(tick).pose);
    });
}

Traces traceBoth(const config::Species& species,
                 const motion::Repertoire& repertoire,
                 const Script& script) {
    const Trace fish = traceFish(species, script);
    return {fish, traceReplicaInPhase(repertoire, script, fish), traceReplica(repertoire, script)};
}

}  // namespace aquarama::report
