// SPDX-License-Identifier: Apache-2.0
// Makes a rig for this machine: from a few measured lengths to a commented file that passes
// `aquarama check`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "common/machine/connectors.h"

namespace aquarama {

// The kind of display that shows the world.
enum class WallKind { Televisions, Cylinder, Flat };

// The wishes for a new rig; empty where not given. Metres, degrees.
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

// All values of the rig's file.
struct RigPlan {
    std::string name;
    NewRigWishes wishes;  // each with a value, where its kind needs it
    std::vector<PlannedChannel> channels;
};

// The default values.
inline constexpr double kDiagonalInches = 55;
inline constexpr glm::ivec2 kSizePixels{1920, 1080};
inline constexpr int kMostNewChannels = 16;

// The monitors for a wall: all, but a laptop's own panel only where it is the only one.
[[nodiscard]] std::vector<machine::Connector> wallMonitors(
    std::vector<machine::Connector> connected);

// Diagonal of the first monitor that reports its size; kDiagonalInches where none does.
[[nodiscard]] double usualDiagonal(const std::vector<machine::Connector>& monitors);

// Fills in missing wishes, from the connected monitors and from the defaults. Throws Error where
// there are too few monitors.
[[nodiscard]] RigPlan planOf(NewRigWishes wishes,
                             const std::vector<machine::Connector>& connected,
                             const std::string& name);

// The text of the rig's file.
[[nodiscard]] std::string textOf(const RigPlan& plan);

}  // namespace aquarama
