// SPDX-License-Identifier: Apache-2.0
#include "capture/speed_response.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <sstream>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "capture/dynamics.h"
#include "common/base/log.h"

namespace aquarama::capture {

namespace {

// Steady swimming.

// Fins come to their speed slowly: two beats may be alike long before the fish is steady.
constexpr int kLeastRowedBeats = 20;
constexpr double kInPlaceBodyLengths = 1e-3;  // less is no way

// The fewest whole steps in a phase that are no longer than longestStepSeconds(). The small term
// keeps rounding from adding a step.
int stepsPerPhaseOf(const config::Species& species, double periodSeconds) {
    const double longest = longestStepSeconds(makeBiomechanicalFish(species));
    return static_cast<int>(std::ceil(periodSeconds / motion::kPhases / longest - 1e-9));
}

// Advances the swimmer by one beat and records it.
RecordedCycle recordBeat(Swimmer& swimmer, double periodSeconds, int stepsPerPhase) {
    RecordedCycle beat{.periodSeconds = periodSeconds,
                       .poses = {swimmer.state().positions},
                       .fins = {swimmer.fins()}};
    for (int phase = 0; phase < motion::kPhases; ++phase) {
        swimmer.advance(stepsPerPhase);
        beat.poses.push_back(swimmer.state().positions);
        beat.fins.push_back(swimmer.fins());
    }
    const PoseFrame first = frameOf(beat.poses.front());
    const glm::dvec3 way = frameOf(beat.poses.back()).origin - first.origin;
    // A fish that stays in its place looks along its course.
    const bool stays = glm::length(way) < kInPlaceBodyLengths;
    beat.course = stays ? first.worldFromBody[0] : glm::normalize(way);
    return beat;
}

// The displacement of the body frame's origin since the first pose, in the body frame of that pose.
glm::dvec3 wayOf(const RecordedCycle& beat, std::size_t phase) {
    const PoseFrame first = frameOf(beat.poses.front());
    return glm::transpose(first.worldFromBody) *
           (frameOf(beat.poses.at(phase)).origin - first.origin);
}

[[noreturn]] void refuse(const config::Species& species, const config::Gait& gait) {
    std::ostringstream message;
    message << species.name << ": swimming at " << gait.beatHertz
            << " beats a second and a gain of " << gait.gain
            << " does not come to repeat itself within " << kMostBeats
            << " beats; change `swim`, `tissue` or `water` in its species file";
    throw Error(message.str());
}

}  // namespace

double differenceOf(const RecordedCycle& beat, const RecordedCycle& next) {
    assert(beat.poses.size() == next.poses.size());
    double most = 0;
    // std::max would lose a NaN.
    const auto note = [&](const glm::dvec3& a, const glm::dvec3& b) {
        const double difference = glm::distance(a, b);
        if (difference > most || std::isnan(difference)) most = difference;
    };
    for (std::size_t phase = 0; phase < beat.poses.size(); ++phase) {
        const NodeVectors a = inBodyFrame(beat.poses.at(phase));
        const NodeVectors b = inBodyFrame(next.poses.at(phase));
        for (std::size_t i = 0; i < a.size(); ++i) note(a.at(i), b.at(i));
        note(wayOf(beat, phase), wayOf(next, phase));
    }
    return most;
}

// The step divides the beat exactly, so that poses of the same phase can be compared.
SteadySwimming swimUntilSteady(const config::Species& species, const Order& order) {
    assert(order.gait.beatHertz > 0);
    const double periodSeconds = 1 / order.gait.beatHertz;
    const int steps = stepsPerPhaseOf(species, periodSeconds);
    SteadySwimming steady{.swimmer = Swimmer(species, periodSeconds / (motion::kPhases * steps)),
                          .beat = {},
                          .stepsPerPhase = steps};
    steady.swimmer.give(order);
    steady.beat = recordBeat(steady.swimmer, periodSeconds, steps);
    const int leastBeats = order.gait.rows > 0 ? kLeastRowedBeats : 2;
    for (steady.beats = 2; steady.beats <= kMostBeats; ++steady.beats) {
        RecordedCycle next = recordBeat(steady.swimmer, periodSeconds, steps);
        const double difference = differenceOf(steady.beat, next);
        steady.beat = std::move(next);
        if (difference <= kRepeatsBodyLengths && steady.beats >= leastBeats) return steady;
        if (std::isnan(difference)) break;
    }
    refuse(species, order.gait);
}

SteadySwimming swimUntilSteady(const config::Species& species, const config::Gait& gait) {
    return swimUntilSteady(species, {.controller = Controller::ForwardSwim, .gait = gait});
}

Order rowingOrder(const config::Species& species, Controller controller) {
    const config::Rowing& rowing = species.finMotion.rowing;
    if (!rowing.rows()) return {.controller = Controller::Glide, .gait = species.swim.slow};
    return {.controller = controller,
            .gait = {.beatHertz = static_cast<double>(rowing.beatHertz), .rows = 1}};
}

namespace {

// Transitions.

// How long a transition is recorded, in beats of the new gait, or for glide and brake of the old
// one. By then a fish that changes gait is within a few per cent of its new speed, and one that
// brakes is nearly at rest.
constexpr int kSwumBeats = 12;
constexpr int kGlidedBeats = 8;
constexpr int kBrakedBeats = 2;

using Masses = std::array<double, body::kNodalPoints>;  // sum 1

// Weighted by mass: of places the centre of mass, of velocities its velocity.
glm::dvec3 meanOf(const NodeVectors& vectors, const Masses& masses) {
    glm::dvec3 mean{};
    for (std::size_t i = 0; i < vectors.size(); ++i) mean += masses.at(i) * vectors.at(i);
    return mean;
}

glm::dvec3 meanVelocityOf(const RecordedCycle& beat) {
    return (frameOf(beat.poses.back()).origin - frameOf(beat.poses.front()).origin) /
           beat.periodSeconds;
}

// A glide or a brake out of steady swimming. The tail does not beat, so no mean over a beat is
// taken: a sample a phase, of the instantaneous speed.
Transition coast(const SteadySwimming& from,
                 Controller controller,
                 int beats,
                 const Masses& masses) {
    Swimmer swimmer = from.swimmer;
    swimmer.give({.controller = controller});
    Transition transition{.sampleSeconds = from.beat.periodSeconds / motion::kPhases, .speeds = {}};
    for (int sample = 0; sample <= beats * motion::kPhases; ++sample) {
        transition.speeds.push_back(glm::length(meanOf(swimmer.state().velocities, masses)));
        swimmer.advance(from.stepsPerPhase);
    }
    return transition;
}

// A retreat out of medium swimming. Only its fins beat, so no mean over a beat is taken either.
Transition backOut(const SteadySwimming& medium,
                   const SteadySwimming& retreat,
                   const Order& order,
                   const Masses& masses) {
    Swimmer swimmer = medium.swimmer;
    swimmer.give(order);
    Transition transition{.sampleSeconds = medium.beat.periodSeconds / motion::kPhases,
                          .segmentSpeed = -glm::length(meanVelocityOf(retreat.beat)),
                          .speeds = {}};
    const double seconds = kSwumBeats * retreat.beat.periodSeconds;
    while (transition.sampleSeconds * static_cast<double>(transition.speeds.size()) < seconds) {
        transition.speeds.push_back(
            glm::dot(meanOf(swimmer.state().velocities, masses), medium.beat.course));
        swimmer.advance(medium.stepsPerPhase);
    }
    return transition;
}

// The transition from one gait to another, one sample in each step. A sample is the mean speed over
// a beat of `to` around it: from the place half a beat before to that half a beat after, by time.
// For the first samples the half beat before the order is extrapolated from the steady speed of
// `from`.
Transition changeTo(const SteadySwimming& to,
                    const SteadySwimming& from,
                    const config::Gait& gait,
                    const Masses& masses) {
    Swimmer swimmer = from.swimmer;
    swimmer.give({.controller = Controller::Balance, .gait = gait});
    const double step = swimmer.stepSeconds();
    const auto halfBeat = static_cast<std::size_t>(std::lround(to.beat.periodSeconds / step / 2));
    const glm::dvec3 velocity = meanVelocityOf(from.beat);
    const glm::dvec3 start = meanOf(swimmer.state().positions, masses);
    // Centres of mass, from half a beat before the order on.
    std::vector<glm::dvec3> places;
    for (std::size_t back = halfBeat; back > 0; --back)
        places.push_back(start - velocity * (step * static_cast<double>(back)));
    for (std::size_t i = 0; i <= (2 * kSwumBeats + 1) * halfBeat; ++i) {
        places.push_back(meanOf(swimmer.state().positions, masses));
        swimmer.advance(1);
    }
    Transition transition{
        .sampleSeconds = step, .segmentSpeed = glm::length(meanVelocityOf(to.beat)), .speeds = {}};
    for (std::size_t i = 0; i + 2 * halfBeat < places.size(); ++i)
        transition.speeds.push_back(glm::distance(places[i + 2 * halfBeat], places[i]) /
                                    (step * static_cast<double>(2 * halfBeat)));
    transition.speeds.front() = glm::length(velocity);
    return transition;
}

}  // namespace

Transitions swimTransitions(const config::Species& species,
                            const SteadyGaits& gaits,
                            const SteadySwimming& retreat) {
    assert(std::ranges::none_of(gaits, [](const SteadySwimming* gait) { return !gait; }));
    const Masses masses = makeBiomechanicalFish(species).masses;
    const std::array orders{&species.swim.slow, &species.swim.medium, &species.swim.fast};
    const SteadySwimming& medium = *gaits[static_cast<std::size_t>(motion::Action::ForwardMedium)];
    Transitions transitions{
        .swim = {},
        .glide = coast(medium, Controller::Glide, kGlidedBeats, masses),
        .brake = coast(medium, Controller::Brake, kBrakedBeats, masses),
        .retreat = backOut(medium, retreat, rowingOrder(species, Controller::Retreat), masses)};
    for (std::size_t to = 0; to < gaits.size(); ++to)
        for (std::size_t from = 0; from < gaits.size(); ++from)
            if (from != to)
                transitions.swim.at(to).push_back(
                    changeTo(*gaits.at(to), *gaits.at(from), *orders.at(to), masses));
    return transitions;
}

double acceleration(const SpeedLaw& law, double segmentSpeed, double speed) {
    const double excess = segmentSpeed > 0 ? std::max(speed - segmentSpeed, 0.0) : 0;
    const double against =
        std::abs(segmentSpeed) + static_cast<double>(motion::kExcessDrag) * excess;
    return law.swimDrag * against * (segmentSpeed - speed) -
           law.glideDrag * speed * std::abs(speed) - law.brakeRate * speed;
}

double fitTerm(const std::vector<Transition>& transitions,
               double SpeedLaw::*term,
               const SpeedLaw& known) {
    assert(term != nullptr);
    assert(known.*term == 0);
    SpeedLaw unit;
    unit.*term = 1;
    double products = 0;
    double squares = 0;
    for (const Transition& transition : transitions) {
        const std::vector<double>& v = transition.speeds;
        double explained = 0;  // K of the header's formula, by the trapezoidal rule
        double integral = 0;   // X
        for (std::size_t i = 1; i < v.size(); ++i) {
            const auto gained = [&](const SpeedLaw& law) {
                const auto at = [&](std::size_t sample) {
                    return acceleration(law, transition.segmentSpeed, v[sample]);
                };
                return transition.sampleSeconds * (at(i - 1) + at(i)) / 2;
            };
            explained += gained(known);
            integral += gained(unit);
            products += integral * (v[i] - v.front() - explained);
            squares += integral * integral;
        }
    }
    return squares > 0 ? std::max(0.0, products / squares) : 0;
}

motion::SpeedResponse fitResponse(const Transitions& transitions) {
    const SpeedLaw gliding{.glideDrag = fitTerm({transitions.glide}, &SpeedLaw::glideDrag, {})};
    motion::SpeedResponse response{.glideDrag = static_cast<float>(gliding.glideDrag)};
    for (std::size_t gait = 0; gait < transitions.swim.size(); ++gait)
        response.swimDrag.at(gait) =
            static_cast<float>(fitTerm(transitions.swim.at(gait), &SpeedLaw::swimDrag, {}));
    response.retreatDrag =
        static_cast<float>(fitTerm({transitions.retreat}, &SpeedLaw::swimDrag, {}));
    response.brakeRate =
        static_cast<float>(fitTerm({transitions.brake}, &SpeedLaw::brakeRate, gliding));
    return response;
}

}  // namespace aquarama::capture
