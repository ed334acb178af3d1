// SPDX-License-Identifier: Apache-2.0
// What a rig's projectors do to its screen, in the numbers that a crew asks for.
#pragma once

#include <string>
#include <vector>

#include "common/config/rig.h"

namespace aquarama::theatre {

struct ChannelOverlap {
    std::string with;   // the other channel
    double pixels = 0;  // of this channel's picture, along the screen's mid-height
    double degrees = 0;
};

struct ChannelSurvey {
    std::string name;
    double leftDegrees = 0, rightDegrees = 0;  // azimuths of what it lights; right is positive
    double bottomMetres = 0, topMetres = 0;    // above the sweet spot
    glm::dvec2 pixelsPerDegree{};              // in the middle of what it lights
    std::vector<ChannelOverlap> overlaps;
};

[[nodiscard]] ChannelSurvey surveyChannel(const config::Rig& rig, std::size_t channel);

// The largest deviation from one of the sum of all shares on the screen, of many points.
[[nodiscard]] double worstBlendSum(const config::Rig& rig);

// The survey in one line.
[[nodiscard]] std::string oneLine(const ChannelSurvey& survey);

}  // namespace aquarama::theatre
