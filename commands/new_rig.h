// SPDX-License-Identifier: Apache-2.0
// A rig for the machine at hand: from what somebody measured with a tape to a commented file that
// `aquarama check` calls good.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "common/machine/connectors.h"

namespace aquarama {

// What the world appears on.
enum class WallKind { Televisions, Cylinder, Flat };

// What was said of a new rig; nothing where it was not. Metres, degrees.
struct NewRigWishes {
    std::optional<WallKind> kind;
    std::optional<int> count;             // of televisions or projectors
    std::vector<std::string> connectors;  // from left to right; none: those found
    std::optional<glm::ivec2> sizePixels;
    bool windows = false;  // on this desktop, instead of whole monitors
    std::string scene;     // path for the rig
    // Of televisions: the diagonal of the picture in inches, the width of the frame, the angle
    // between neighbours.
    std::optional<double> diagonalInches, bezel, angle;
    // Of a screen; the eye is in the middle of a curved one. Also of the middle television.
    std::optional<double> radius, arc, height, width, distance;
    // Of projectors: distance by width of the picture, and how high they hang above the eye.
    std::optional<double> throwRatio, mount;
};

// One television or projector.
struct PlannedChannel {
    std::string name;
    std::string connector;  // empty: a window
    glm::ivec2 sizePixels{};
    glm::dvec2 sizeMetres{};  // of a television's picture
};

// All that a rig needs to be written.
struct RigPlan {
    std::string name;
    NewRigWishes wishes;  // each with a value, where its kind needs it
    std::vector<PlannedChannel> channels;
};

// What is taken where nothing else is said.
inline constexpr double kDiagonalInches = 55;
inline constexpr glm::ivec2 kSizePixels{1920, 1080};
inline constexpr int kMostNewChannels = 16;

// The monitors that a wall is made of: without a laptop's own panel, where there are others.
[[nodiscard]] std::vector<machine::Connector> wallMonitors(
    std::vector<machine::Connector> connected);

// Of the picture of the first of them that tells its size; kDiagonalInches where none does.
[[nodiscard]] double usualDiagonal(const std::vector<machine::Connector>& monitors);

// Fills in what was not said, from the monitors that are connected and from habit. Throws Error
// where there are too few monitors.
[[nodiscard]] RigPlan planOf(NewRigWishes wishes,
                             const std::vector<machine::Connector>& connected,
                             const std::string& name);

// The file.
[[nodiscard]] std::string textOf(const RigPlan& plan);

}  // namespace aquarama
