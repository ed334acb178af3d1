// SPDX-License-Identifier: Apache-2.0
#include "master/capture/compile/speed_response.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <glm/geometric.hpp>

#include "master/capture/dynamics/body_frame.h"

namespace aquarama {

namespace {

// In beats of the gait that is swum, or was. By then a fish that changes gait has come within a few
// per cent of its new speed, and one that brakes stands.
constexpr int kSwumBeats = 12;
constexpr int kGlidedBeats = 8;
constexpr int kBrakedBeats = 2;

using Masses = std::array<double, kNodalPoints>;  // sum 1

glm::dvec3 meanOf(const NodeVectors& vectors, const Masses& masses) {
    glm::dvec3 mean{};
    for (std::size_t i = 0; i < vectors.size(); ++i) mean += masses.at(i) * vectors.at(i);
    return mean;
}

double speedOf(const Recording& beat) {
    return glm::distance(frameOf(beat.poses.front()).origin, frameOf(beat.poses.back()).origin) /
           beat.periodSeconds;
}

Transition coast(const SteadySwimming& from,
                 Controller controller,
                 int beats,
                 const Masses& masses) {
    Swimmer swimmer = from.swimmer;
    swimmer.give({.controller = controller});
    Transition transition{.sampleSeconds = from.beat.periodSeconds / kPhases, .speeds = {}};
    for (int sample = 0; sample <= beats * kPhases; ++sample) {
        transition.speeds.push_back(glm::length(meanOf(swimmer.state().velocities, masses)));
        swimmer.advance(from.stepsPerPhase);
    }
    return transition;
}

// A sample is the mean over the beat of `to` that begins with it.
Transition changeGait(const SteadySwimming& from,
                      const SteadySwimming& to,
                      const Gait& gait,
                      const Masses& masses) {
    Swimmer swimmer = from.swimmer;
    swimmer.give({.controller = Controller::ForwardSwim, .gait = gait});
    const auto beat =
        static_cast<std::size_t>(std::lround(to.beat.periodSeconds / swimmer.stepSeconds()));
    std::vector<glm::dvec3> places;
    for (std::size_t step = 0; step <= (kSwumBeats + 1) * beat; ++step) {
        places.push_back(meanOf(swimmer.state().positions, masses));
        swimmer.advance(1);
    }
    Transition transition{
        .sampleSeconds = swimmer.stepSeconds(), .segmentSpeed = speedOf(to.beat), .speeds = {}};
    for (std::size_t step = 0; step + beat < places.size(); ++step)
        transition.speeds.push_back(glm::distance(places[step], places[step + beat]) /
                                    (swimmer.stepSeconds() * static_cast<double>(beat)));
    return transition;
}

// What drag multiplies in the law.
double excess(double segmentSpeed, double speed) {
    return segmentSpeed * std::abs(segmentSpeed) - speed * std::abs(speed);
}

}  // namespace

Transitions swimTransitions(const Species& species,
                            const SteadySwimming& slow,
                            const SteadySwimming& medium,
                            const SteadySwimming& fast) {
    const Masses masses = makeBiomechanicalFish(species).masses;
    return {.slowToFast = changeGait(slow, fast, species.swim.fast, masses),
            .mediumToSlow = changeGait(medium, slow, species.swim.slow, masses),
            .glide = coast(medium, Controller::Glide, kGlidedBeats, masses),
            .brake = coast(medium, Controller::Brake, kBrakedBeats, masses)};
}

double fitDrag(const std::vector<Transition>& transitions) {
    double products = 0;
    double squares = 0;
    for (const Transition& transition : transitions) {
        const std::vector<double>& v = transition.speeds;
        double integral = 0;
        for (std::size_t i = 1; i < v.size(); ++i) {
            integral += transition.sampleSeconds *
                        (excess(transition.segmentSpeed, v[i - 1]) +
                         excess(transition.segmentSpeed, v[i])) /
                        2;
            products += integral * (v[i] - v.front());
            squares += integral * integral;
        }
    }
    return squares > 0 ? std::max(0.0, products / squares) : 0;
}

std::vector<double> replayLaw(const Transition& transition, double drag) {
    std::vector<double> speeds{transition.speeds.front()};
    while (speeds.size() < transition.speeds.size()) {
        const double v = speeds.back();
        speeds.push_back(v + transition.sampleSeconds * drag * excess(transition.segmentSpeed, v));
    }
    return speeds;
}

SpeedResponse fitResponse(const Transitions& transitions) {
    const double glide = fitDrag({transitions.glide});
    const double brake = fitDrag({transitions.brake});
    return {
        .swimDrag = static_cast<float>(fitDrag({transitions.slowToFast})),
        .glideDrag = static_cast<float>(glide),
        .brakeDrag = static_cast<float>(std::max(0.0, brake - glide))};
}

}  // namespace aquarama
