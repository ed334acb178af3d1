// SPDX-License-Identifier: Apache-2.0
// The output of `aquarama check` and `inspect`: what a rig's projectors light, in the numbers that
// a crew asks for, and the contents of the files of scenes and species.
#pragma once

#include <string>
#include <vector>

#include "common/config/rig.h"
#include "common/config/scene.h"
#include "common/wall/wall.h"

namespace aquarama::compose {

// Several lines about a scene or a species, without the last line break. `path`: its file. Throws
// Error with file:line:column where the scene has no room for its fish, or for a mistake in a file
// of its cast.
[[nodiscard]] std::string inventoryOf(const config::Scene& scene, const std::string& path);
[[nodiscard]] std::string inventoryOf(const config::Species& species, const std::string& path);

// The overlap of a channel with another one.
struct ChannelOverlap {
    std::string with;   // the other channel
    double pixels = 0;  // of this channel's picture, along a cylinder's mid-height
    double degrees = 0;
    double share = 0;  // of this channel's picture
};

// The area that a channel lights.
struct ChannelSurvey {
    std::string name;
    double leftDegrees = 0, rightDegrees = 0;  // azimuths of what it lights; right is positive
    double bottomMetres = 0, topMetres = 0;    // above the sweet spot
    double bottomDegrees = 0, topDegrees = 0;  // elevations
    bool isUpright = false;  // the screen is an upright cylinder: heights tell more than angles
    glm::dvec2 pixelsPerDegree{};  // in the middle of what it lights
    std::vector<ChannelOverlap> overlaps;
};

// Surveys the channel of this index, which must light a part of the screen (wall::checkGeometry).
// `wall` is the rig's.
[[nodiscard]] ChannelSurvey surveyChannel(const config::Rig& rig,
                                          const wall::Wall& wall,
                                          std::size_t channel);

// The largest deviation from one of the sum of all channels' shares of light, over many points of
// the screen that are lit and not masked.
[[nodiscard]] double worstBlendSum(const wall::Wall& wall);

// The survey in one line.
[[nodiscard]] std::string oneLine(const ChannelSurvey& survey);

}  // namespace aquarama::compose
