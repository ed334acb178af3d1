// SPDX-License-Identifier: Apache-2.0
#include "master/capture/report/controller_trial.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <glm/geometric.hpp>

#include "master/capture/dynamics/body_frame.h"

namespace aquarama::report {

namespace {

// Along the body's axis: backward is negative.
double speedOver(capture::Swimmer& swimmer, double seconds) {
    const glm::dvec3 from = middleOf(swimmer.state().positions);
    const double start = swimmer.seconds();
    swimmer.advance(static_cast<int>(std::lround(seconds / swimmer.stepSeconds())));
    const capture::PoseFrame frame = capture::frameOf(swimmer.state().positions);
    return glm::dot(frame.origin - from, frame.worldFromBody[0]) / (swimmer.seconds() - start);
}

ControllerTrial record(capture::Swimmer swimmer,
                       const capture::Order& order,
                       double seconds,
                       double speedBefore) {
    ControllerTrial trial{.moments = {}, .speedBefore = speedBefore};
    const glm::dvec3 start = middleOf(swimmer.state().positions);
    const double begin = swimmer.seconds();
    swimmer.give(order);
    for (int i = 0; i <= kMoments; ++i) {
        const double until = begin + seconds * i / kMoments;
        swimmer.advance(
            static_cast<int>(std::lround((until - swimmer.seconds()) / swimmer.stepSeconds())));
        Moment moment{.seconds = swimmer.seconds() - begin,
                      .nodes = swimmer.state().positions,
                      .fins = swimmer.control().fins};
        for (glm::dvec3& node : moment.nodes) node -= start;
        trial.moments.push_back(moment);
    }
    trial.speedAfter = speedOver(swimmer, 1 / std::max(order.gait.beatHertz, 3.0));
    return trial;
}

}  // namespace

glm::dvec3 middleOf(const capture::NodeVectors& nodes) {
    return capture::frameOf(nodes).origin;
}

ControllerTrial swimmingThen(const config::Species& species,
                             const capture::Order& order,
                             double seconds,
                             double runUpBeats) {
    const config::Gait& medium = species.swim.medium;
    capture::Swimmer swimmer(species);
    swimmer.give({.controller = capture::Controller::ForwardSwim, .gait = medium});
    speedOver(swimmer, runUpBeats / medium.beatHertz);
    const double speed = speedOver(swimmer, 1 / medium.beatHertz);
    return record(std::move(swimmer), order, seconds, speed);
}

ControllerTrial rolledThen(const config::Species& species,
                           double rollRadians,
                           const capture::Order& order,
                           double seconds) {
    const double cosine = std::cos(rollRadians);
    const double sine = std::sin(rollRadians);
    capture::BiomechanicalFish fish = capture::makeBiomechanicalFish(species);
    for (glm::dvec3& x : fish.restPositions)
        x = {x.x, cosine * x.y + sine * x.z, -sine * x.y + cosine * x.z};
    return record({fish, species.swim, capture::longestStepSeconds(fish)}, order, seconds, 0);
}

ControllerTrial restingThen(const config::Species& species,
                            const capture::Order& order,
                            double seconds) {
    return record(capture::Swimmer(species), order, seconds, 0);
}

}  // namespace aquarama::report
