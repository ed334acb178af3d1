// SPDX-License-Identifier: Apache-2.0
// A rig: the wall, its projectors and channels, and the addresses of one installation, as plain
// data.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "common/base/brown_lens.h"
#include "common/base/digest.h"
#include "common/config/host.h"
#include "common/config/text_file.h"

namespace aquarama::config {

// How fine a wall is drawn. All nodes of a wall draw at the same tier, or their pictures would part
// where they overlap; render_node/scene/quality.h says what each buys.
enum class QualityTier : std::uint8_t {
    Low,     // software OpenGL on two cores, live
    Medium,  // a small GPU
    High,    // a GPU of today
    Ultra,   // no expense spared: pictures, references
};
// As command lines name them, in the order of the tiers.
inline constexpr std::array<std::string_view, 4> kTierNames{"low", "medium", "high", "ultra"};

// The word of a tier in files and command lines.
[[nodiscard]] constexpr std::string_view nameOf(QualityTier tier) {
    return kTierNames.at(static_cast<std::size_t>(tier));
}
// Nothing where there is no such tier: for numbers and names from outside.
[[nodiscard]] constexpr std::optional<QualityTier> tierAt(std::uint32_t index) {
    if (index >= kTierNames.size()) return std::nullopt;
    return static_cast<QualityTier>(index);
}
[[nodiscard]] constexpr std::optional<QualityTier> tierNamed(std::string_view name) {
    const auto found = std::ranges::find(kTierNames, name);
    return tierAt(static_cast<std::uint32_t>(found - kTierNames.begin()));
}

// What light falls on.
enum class ScreenShape : std::uint8_t { Cylinder, Flat, Dome, Measured, Panels };

// Wall frame: metres, Y up, the screen's middle ahead of the origin (-z), where the sweet spot is
// unless a rig moves it. rig.proto says how each shape lies there.
struct Screen {
    ScreenShape shape = ScreenShape::Cylinder;
    double radiusMetres = 0;    // cylinder, dome
    double arcRadians = 0;      // cylinder; of a dome its opening
    double widthMetres = 0;     // flat
    double heightMetres = 0;    // cylinder, flat
    double distanceMetres = 0;  // flat
    double tiltRadians = 0;     // about +X, the front going down; not of measured ones and panels
    std::string meshFile = {};  // measured: name in Rig::files
    bool hidesBezels = false;   // panels
    SourcePlace place = {};
};

// A pinhole with a lens: x right, y up, looking along -Z of its own frame.
struct Projector {
    glm::dvec3 positionMetres{};        // wall frame
    glm::dvec3 yawPitchRollRadians{};   // yaw about +Y (left positive), then pitch about +X (up
                                        // positive), then roll about +Z
    glm::dvec2 focalPixels{};           // fx and fy differ where pixels are not square
    glm::dvec2 principalPixels{};       // from the top left corner of the picture
    BrownLens<double> distortion = {};  // k1 and k2 only
};

// A flat display, x right and y up on it, its face towards +Z of its own frame.
struct Panel {
    glm::dvec3 positionMetres{};       // of its middle, wall frame
    glm::dvec3 yawPitchRollRadians{};  // as a projector's
    glm::dvec2 sizeMetres{};           // of the picture
    double bezelMetres = 0;
};

// One channel of a file that another program has written.
struct WallFileRegion {
    std::string file;  // name in Rig::files
    std::string region;
    std::string frustum;  // another; empty: none
};

// What takes the picture of a channel: a window on a desktop, or a whole monitor.
enum class DisplayMode : std::uint8_t { Window, Fullscreen };

// How the pictures of two eyes share what one display takes; in the schema's order.
enum class StereoMode : std::uint8_t {
    Mono,
    QuadBuffer,  // the driver's left and right buffers
    SideBySide,  // halves, squeezed
    TopBottom,   // left above
    Interlaced,  // left in the first row
    Anaglyph     // red and cyan
};

// As the rig's file names it: "SIDE_BY_SIDE".
[[nodiscard]] std::string nameOf(StereoMode mode);

// How a wall shows two eyes.
struct Stereo {
    StereoMode mode = StereoMode::Mono;
    double eyeSeparationMetres = 0;
    bool swapEyes = false;
};

// Where and how a node shows its channel.
struct Display {
    DisplayMode mode = DisplayMode::Window;
    std::string connector = {};               // for fullscreen; empty: the only monitor
    glm::ivec2 windowPosition{};              // top left corner on the desktop, for a window
    std::string device = "auto";              // auto | nvidia | mesa | surfaceless | device:N
    std::optional<double> refreshHertz = {};  // refused where the monitor's differs
    std::optional<StereoMode> stereo = {};    // instead of the rig's
    std::optional<bool> swapEyes = {};        // instead of the rig's
};

// One projector or panel, the picture that it shows and the node that draws it.
struct Channel {
    std::uint32_t id = 0;
    std::string name;
    glm::ivec2 sizePixels{};  // of its picture
    Projector projector;      // all 0 where one of these stands in its place
    std::optional<Panel> panel = {};
    std::optional<WallFileRegion> wallFile = {};
    Display display;
    std::string machine;  // whose node shows it; empty: the master's
    SourcePlace place;
};

// Of the whole wall.
struct Timing {
    double refreshHertz = 0;
    double presentDeadlineSeconds = 0;  // how long the first ready node waits for the others
    double membershipSeconds = 0;       // silence after which a node is no longer counted
};

// How a theatre's desk drives a running show by Open Sound Control.
struct OscCues {
    UdpAddress listen;
    std::vector<std::string> from;   // hosts whose cues count, as shortestHost() has them
    std::vector<UdpAddress> sendTo;  // are told what the wall shows
};

// How a lighting desk drives a running show: channels of a universe of DMX that olad hears.
struct DmxCues {
    std::uint32_t universe = 0;
    std::optional<std::uint32_t> brightness, black;  // channels, 1 to 512; nothing: not driven
};

// The desks of a theatre that drive a running show; nothing: there is none.
struct Cues {
    std::optional<OscCues> osc = {};
    std::optional<DmxCues> dmx = {};
};

// Of a file that a rig names; never null. Copies of a rig share it: it may be large.
using FileContent = std::shared_ptr<const std::vector<std::byte>>;

// Visitors who take part by phone, and where their sign is drawn.
struct Guests {
    // Of the channel's picture.
    enum class Corner : std::uint8_t { LowerLeft, LowerRight, UpperLeft, UpperRight };
    std::string host;  // address of this machine that phones reach, of version 4 or 6
    std::uint16_t port = 0;
    std::string channel;  // draws the sign
    Corner corner = Corner::LowerLeft;
    double height = 0.16;              // share of the channel's picture
    std::string picturesAddress = {};  // where nodes bring it pictures: ROUTER; empty: nowhere
};

// What visitors have painted swims on the wall.
struct DrawingRules {
    std::vector<std::string> species;  // names of those that have sheets
    std::uint32_t most = 60;           // that swim at once
    bool areLetInAtOnce = false;       // else the crew lets each in
    bool mayBeEaten = false;
    std::string folder;  // of pictures to be read, relative to the rig's; empty: none
};

// Where hands before the wall are told, and the surface that their tracker watches: three of its
// corners, wall frame, metres.
struct TouchedSurface {
    UdpAddress listen;
    std::vector<std::string> from;  // hosts whose hands count, as shortestHost() has them
    glm::dvec3 topLeft{}, topRight{}, bottomLeft{};
    // Of people on the floor: how far from the screen they count, metres. Nothing: it tells hands.
    std::optional<double> peopleReachMetres = {};
};

// A second machine that takes over when the master's machine dies.
struct Standby {
    std::string machine;                       // as people know it
    std::string controlAddress, stateAddress;  // where it listens once it is the master
    std::vector<std::string> etcd;             // URLs of the members of etcd
};

// Where the master's machine also listens, ROUTER; empty: nowhere.
struct SideAddresses {
    std::string watch;  // nodes bring pictures to the console
    std::string depot;  // machines ask for releases
};

// Where a rig's file says some of its values, for errors.
struct RigPlaces {
    SourcePlace scene, sweetSpot, touch;
};

// A whole installation. Where its file leaves something out it has what rig.proto says.
struct Rig {
    std::string text;  // of the file, as it was read: the nodes are sent it
    std::string name;
    Screen screen;
    glm::ivec2 panoramaPixels{};  // the unrolled wall, for the composed pictures
    std::string controlAddress;   // "tcp://127.0.0.1:7400": ROUTER
    std::string stateAddress;     // "tcp://127.0.0.1:7401": PUB
    // Of the master; that of channel i is i + 1 higher. 0: no figures are served.
    std::uint16_t metricsPort = 0;
    std::uint16_t consolePort = 0;  // of the operator's console; 0: none
    SideAddresses sides = {};
    bool windowsEndShow = false;  // by q and Esc
    Cues cues = {};
    std::vector<Channel> channels;
    Timing timing;
    std::string scene;  // path of the file of what is shown, relative to the rig's folder
    Stereo stereo;
    glm::dvec3 sweetSpotMetres{};        // wall frame: between the viewer's eyes
    std::optional<QualityTier> quality;  // nothing: measured at start
    std::string calibration = {};        // name in `files`; empty: none
    std::string adjustments = {};        // name in `files`; empty: none. See adjustments.h
    std::optional<Guests> guests = {};
    std::optional<TouchedSurface> touch = {};
    std::optional<DrawingRules> drawings = {};
    std::optional<Standby> standby = {};
    RigPlaces places = {};
    // Measured screens, wall files and adjustments, whole, by the name that the rig has for them.
    std::map<std::string, FileContent> files;
};

// Reads a rig and holds it to rig.proto and to what no single field can tell (overlapping ids, a
// bind past the loopback): throws Error with file:line:column. `source` is the file's name in
// errors. Geometry (a projector that misses the screen) is checked by common/wall.
[[nodiscard]] Rig readRig(const std::string& path);
// Without the files that it names: `files` has empty ones.
[[nodiscard]] Rig parseRig(const std::string& text, const std::string& source);
// Reads the files that a rig names from its folder, as readRig() does. Throws Error where one
// cannot be read or is larger than kMostWallFileBytes.
void readRigFiles(Rig& rig, const std::string& rigPath);
inline constexpr std::size_t kMostWallFileBytes = kMostBlobBytes;

// As its crew has hung it, about: without calibration, adjustments and wall files, which need not
// be there. Throws Error where a channel has no projector.
[[nodiscard]] Rig readRigAsHung(const std::string& path);

// Whether its master listens past its own machine, where everybody needs a key.
[[nodiscard]] bool needsKeys(const Rig& rig);

// Where the scene lies that a rig shows. Throws Error at its place in the rig where there is none.
[[nodiscard]] std::string scenePathOf(const Rig& rig, const std::string& rigPath);

}  // namespace aquarama::config
