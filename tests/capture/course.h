// SPDX-License-Identifier: Apache-2.0
// Where a swimmer goes, and how it lies in the water.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "capture/dynamics.h"
#include "capture/swimmer.h"
#include "common/base/units.h"

namespace aquarama::capture {

inline void advanceSeconds(Swimmer& swimmer, double seconds) {
    swimmer.advance(static_cast<int>(std::lround(seconds / swimmer.stepSeconds())));
}

inline glm::dvec3 centreOf(const Swimmer& swimmer) {
    const NodeVectors& x = swimmer.state().positions;
    return (x[5] + x[6] + x[7] + x[8]) / 4.0;
}

// Over a stretch of time; where that is a whole number of beats, without the sway of the beat.
struct Course {
    glm::dvec3 velocity{};          // body lengths a second
    double towardsRadians = 0;      // of the path over the horizon, left of +x positive
    double alongBody = 0;           // velocity along the body's axis as it is at the end
    double meanPitchRadians = 0;    // of the body
    double meanHeadingRadians = 0;  // of the body
    double mostRollRadians = 0;     // either way
};

inline Course courseOver(Swimmer& swimmer, double seconds) {
    constexpr int kSamples = 48;
    const glm::dvec3 from = centreOf(swimmer);
    const double start = swimmer.seconds();
    Course course;
    for (int i = 0; i < kSamples; ++i) {
        const double until = start + seconds * (i + 1) / kSamples;
        advanceSeconds(swimmer, until - swimmer.seconds());
        const BodyAngles attitude = bodyAnglesOf(swimmer.state());
        course.meanPitchRadians += attitude.pitchRadians / kSamples;
        course.meanHeadingRadians += attitude.headingRadians / kSamples;
        course.mostRollRadians = std::max(course.mostRollRadians, std::abs(attitude.rollRadians));
    }
    course.velocity = (centreOf(swimmer) - from) / (swimmer.seconds() - start);
    course.towardsRadians = std::atan2(-course.velocity.z, course.velocity.x);
    course.alongBody =
        glm::dot(course.velocity, frameOf(swimmer.state().positions).worldFromBody[0]);
    return course;
}

inline Order forward(const config::Gait& gait) {
    return {.controller = Controller::ForwardSwim, .gait = gait};
}

// In its stride: after so many beats of medium swimming.
inline Swimmer swimming(const config::Species& species, double beats) {
    Swimmer swimmer(species);
    swimmer.give(forward(species.swim.medium));
    advanceSeconds(swimmer, beats / species.swim.medium.beatHertz);
    return swimmer;
}

}  // namespace aquarama::capture
