// SPDX-License-Identifier: Apache-2.0
// Fast starts in the simulation, in the figures by which those of living fish are published
// (Domenici & Blake 1997).
#pragma once

#include <string>

#include <glm/vec3.hpp>

#include "capture/swimmer.h"
#include "common/config/species.h"

namespace aquarama::capture {

// A fast start to the left. Lengths are body lengths; angles are radians from the course before it,
// left positive. Course, speed, radius and way are those of the centre of mass.
struct StartFigures {
    double bendSeconds = 0,
           seconds = 0;             // from the order to the end of the bend, and of the stroke
    double headRadians = 0;         // heading of the body frame at the end of the bend
    double courseRadians = 0;       // course at the end of the stroke
    double courseLaterRadians = 0;  // course as long again after it
    // From the order until the course has turned by kTurnedRadians and stays beyond that to the end
    // of the stroke; infinite where it does not.
    double turnedSeconds = 0;
    double speed = 0;   // at the end of the stroke, a second
    double radius = 0;  // of the circle fitted to the path of both stages
    double way = 0;     // in both stages
    // The greatest mean of the power in kPowerSeconds of both stages, W/kg of body: what the
    // springs gain by the changes of their stiffness and rest lengths, at the lengths that they
    // have.
    double power = 0;
};
inline constexpr double kTurnedRadians = 1.0471975511965976;  // 60 degrees
inline constexpr double kPowerSeconds = 0.01;

// A fast start with a share of the species' bend, of a fish that is at rest or that swims on a
// course. `swimmer` is of that species.
[[nodiscard]] StartFigures startFigures(const config::Species& species,
                                        Swimmer swimmer,
                                        const glm::dvec3& course,
                                        double bendShare);

// A table in Markdown: the three starts of a species out of rest, and the largest one out of slow
// and medium swimming, there with the least and the greatest figure over kRecordedPhases phases of
// the beat. The rows are simulated in the call.
[[nodiscard]] std::string startTableHead();
[[nodiscard]] std::string startTableRows(const config::Species& species);

}  // namespace aquarama::capture
