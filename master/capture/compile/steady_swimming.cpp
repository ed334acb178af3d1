// SPDX-License-Identifier: Apache-2.0
#include "master/capture/compile/steady_swimming.h"

#include <cmath>
#include <sstream>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "common/units/error.h"
#include "master/capture/dynamics/body_frame.h"

namespace aquarama::capture {

namespace {

int stepsPerPhaseOf(const config::Species& species, double periodSeconds) {
    const double longest = longestStepSeconds(makeBiomechanicalFish(species));
    return static_cast<int>(std::ceil(periodSeconds / motion::kPhases / longest - 1e-9));
}

RecordedCycle recordBeat(Swimmer& swimmer, double periodSeconds, int stepsPerPhase) {
    RecordedCycle beat{.periodSeconds = periodSeconds, .poses = {swimmer.state().positions}};
    for (int phase = 0; phase < motion::kPhases; ++phase) {
        swimmer.advance(stepsPerPhase);
        beat.poses.push_back(swimmer.state().positions);
    }
    beat.course =
        glm::normalize(frameOf(beat.poses.back()).origin - frameOf(beat.poses.front()).origin);
    return beat;
}

// Where the body frame has gone since the first pose, in the body frame then.
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
    double most = 0;
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

SteadySwimming swimUntilSteady(const config::Species& species, const config::Gait& gait) {
    const double periodSeconds = 1 / gait.beatHertz;
    const int steps = stepsPerPhaseOf(species, periodSeconds);
    SteadySwimming steady{.swimmer = Swimmer(species, periodSeconds / (motion::kPhases * steps)),
                          .beat = {},
                          .stepsPerPhase = steps};
    steady.swimmer.give({.controller = Controller::ForwardSwim, .gait = gait});
    steady.beat = recordBeat(steady.swimmer, periodSeconds, steps);
    for (steady.beats = 2; steady.beats <= kMostBeats; ++steady.beats) {
        RecordedCycle next = recordBeat(steady.swimmer, periodSeconds, steps);
        const double difference = differenceOf(steady.beat, next);
        steady.beat = std::move(next);
        if (difference <= kRepeatsBodyLengths) return steady;
        if (std::isnan(difference)) break;
    }
    refuse(species, gait);
}

}  // namespace aquarama::capture
