// SPDX-License-Identifier: Apache-2.0
// A rig: the wall, its projectors and channels, and the addresses of one installation, as plain
// data.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/config/quality.h"
#include "common/config/source_place.h"

namespace aquarama::config {

// A piece of an upright cylinder, open towards the audience. Wall frame: metres, Y up, origin on
// the cylinder's axis at the screen's mid-height, where the sweet spot is unless a rig moves it;
// the screen's middle is at (0, 0, -radius).
struct Screen {
    double radiusMetres = 0;
    double arcRadians = 0;
    double heightMetres = 0;
    SourcePlace place;
};

// A pinhole: x right, y up, looking along -Z of its own frame.
struct Projector {
    glm::dvec3 positionMetres{};       // wall frame
    glm::dvec3 yawPitchRollRadians{};  // yaw about +Y (left positive), then pitch about +X (up
                                       // positive), then roll about +Z
    glm::dvec2 focalPixels{};          // fx and fy differ where pixels are not square
    glm::dvec2 principalPixels{};      // from the top left corner of the picture
};

enum class DisplayMode : std::uint8_t { Window, Fullscreen };

// How the pictures of two eyes share what one display takes.
enum class StereoMode : std::uint8_t {
    Mono,
    QuadBuffer,  // the driver's left and right buffers
    SideBySide,  // halves, squeezed
    TopBottom,   // left above
    Interlaced,  // left in the first row
    Anaglyph     // red and cyan
};

struct Stereo {
    StereoMode mode = StereoMode::Mono;
    double eyeSeparationMetres = 0.063;
    bool swapEyes = false;
};

struct Display {
    DisplayMode mode = DisplayMode::Window;
    int monitor = 0;                     // index of the monitor, for fullscreen
    glm::ivec2 windowPosition{};         // top left corner on the desktop, for a window
    std::string device = "auto";         // auto | nvidia | mesa | surfaceless | device:N
    std::optional<double> refreshHertz;  // refused where the monitor's differs
    std::optional<StereoMode> stereo;    // instead of the rig's
    std::optional<bool> swapEyes;        // instead of the rig's
};

struct Channel {
    std::uint32_t id = 0;
    std::string name;
    glm::ivec2 sizePixels{};  // of the projector's picture
    Projector projector;
    Display display;
    SourcePlace place;
};

struct Timing {
    double refreshHertz = 60;
    double presentDeadlineSeconds =
        0;  // how long the first ready node waits for the others; default one refresh
    double membershipSeconds = 0.25;  // silence after which a node is no longer counted
};

struct Rig {
    std::string name;
    Screen screen;
    glm::ivec2 panoramaPixels{};  // the unrolled wall, for the composed pictures
    std::string controlAddress;   // "tcp://127.0.0.1:7400": ROUTER
    std::string stateAddress;     // "tcp://127.0.0.1:7401": PUB
    std::vector<Channel> channels;
    Timing timing;
    std::string scene;  // path of the file of what is shown, relative to the rig's folder
    SourcePlace scenePlace;
    Stereo stereo;
    glm::dvec3 sweetSpotMetres{};  // wall frame: between the viewer's eyes
    SourcePlace sweetSpotPlace;
    std::optional<QualityTier> quality;  // nothing: measured at start
};

// Reads and validates the schema (unknown field, missing value, overlapping ids, zero sizes, a bind
// past the loopback): throws Error with file:line:column. Geometry (a projector that misses the
// screen) is checked by common/wall.
[[nodiscard]] Rig readRig(const std::string& path);
[[nodiscard]] Rig parseRig(const std::string& text, const std::string& source);
[[nodiscard]] std::string writeRig(
    const Rig& rig);  // text that parseRig reads back to the same rig; sent to the nodes

}  // namespace aquarama::config
