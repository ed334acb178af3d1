// SPDX-License-Identifier: Apache-2.0
#include "common/config/rig.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string_view>
#include <utility>

#include <glm/geometric.hpp>

#include "common/base/files.h"
#include "common/base/log.h"
#include "common/base/units.h"
#include "common/config/rig.pb.h"
#include "common/config/rig_network.h"
#include "common/config/rig_parts.h"
#include "common/config/rig_visitors.h"
#include "common/config/text_reader.h"
#include "common/machine/connectors.h"

namespace aquarama::config {

namespace {

static_assert(v1::Stereo::ANAGLYPH - v1::Stereo::MONO == static_cast<int>(StereoMode::Anaglyph));
static_assert(v1::Rig::ULTRA - v1::Rig::LOW == static_cast<int>(QualityTier::Ultra));

// Of a panorama or a channel.
glm::ivec2 sizeOf(const auto& in) {
    return {in.width_px(), in.height_px()};
}

Screen cylinderOf(const TextReader& file, const v1::Screen& in) {
    for (const char* field : {"radius_m", "arc_deg", "height_m"}) file.require(in, field);
    return {.shape = ScreenShape::Cylinder,
            .radiusMetres = in.radius_m(),
            .arcRadians = in.arc_deg() * kDegree,
            .heightMetres = in.height_m()};
}

Screen flatOf(const v1::FlatScreen& in) {
    return {.shape = ScreenShape::Flat,
            .widthMetres = in.width_m(),
            .heightMetres = in.height_m(),
            .distanceMetres = in.distance_m()};
}

Screen domeOf(const v1::DomeScreen& in) {
    return {.shape = ScreenShape::Dome,
            .radiusMetres = in.radius_m(),
            .arcRadians = in.opening_deg() * kDegree};
}

Screen shapeOf(const TextReader& file, const v1::Screen& in) {
    if (in.has_flat()) return flatOf(in.flat());
    if (in.has_dome()) return domeOf(in.dome());
    if (in.has_measured())
        return {.shape = ScreenShape::Measured, .meshFile = in.measured().file()};
    return cylinderOf(file, in);
}

Screen screenOf(const TextReader& file, const v1::Screen& in) {
    const bool isCylinder = in.has_radius_m() || in.has_arc_deg() || in.has_height_m();
    if (int{isCylinder} + in.has_flat() + in.has_dome() + in.has_measured() > 1)
        file.refuse(in,
                    "the screen has two shapes: keep one of radius_m with arc_deg and height_m, "
                    "flat, dome, measured");
    Screen screen = shapeOf(file, in);
    screen.tiltRadians = in.tilt_deg() * kDegree;
    screen.place = file.placeOf(in);
    if (screen.shape == ScreenShape::Measured && screen.tiltRadians != 0)
        file.refuse(in, "tilt_deg", "a measured screen lies as its file says: remove tilt_deg");
    return screen;
}

Standby standbyOf(const v1::Standby& in) {
    return {.machine = in.machine(),
            .controlAddress = in.control(),
            .stateAddress = in.state(),
            .etcd = {in.etcd().begin(), in.etcd().end()}};
}

Timing timingOf(const TextReader& file, const v1::Timing& in) {
    const Timing timing{.refreshHertz = in.refresh_hz(),
                        .presentDeadlineSeconds = in.has_present_deadline_s()
                                                      ? in.present_deadline_s()
                                                      : 1 / in.refresh_hz(),
                        .membershipSeconds = in.membership_s()};
    if (timing.membershipSeconds < timing.presentDeadlineSeconds)
        file.refuse(in,
                    "membership_s",
                    "membership_s is shorter than present_deadline_s, so that every late frame "
                    "would cost a node its place: make it longer");
    return timing;
}

StereoMode modeOf(v1::Stereo::Mode mode) {
    return static_cast<StereoMode>(mode - v1::Stereo::MONO);
}

std::optional<QualityTier> qualityOf(const v1::Rig& in) {
    if (in.quality() == v1::Rig::MEASURED) return std::nullopt;
    return static_cast<QualityTier>(in.quality() - v1::Rig::LOW);
}

Projector projectorOf(const v1::Projector& in, glm::dvec2 sizePixels) {
    return {.positionMetres = positionOf(in.position()),
            .yawPitchRollRadians = {in.yaw_deg() * kDegree,
                                    in.pitch_deg() * kDegree,
                                    in.roll_deg() * kDegree},
            .focalPixels = {in.focal_x_px(), in.focal_y_px()},
            .principalPixels = {in.has_principal_x_px() ? in.principal_x_px() : sizePixels.x / 2,
                                in.has_principal_y_px() ? in.principal_y_px() : sizePixels.y / 2},
            .distortion = {.k1 = in.k1(), .k2 = in.k2()}};
}

// A lens must not fold the picture: r (1 + k1 r^2 + k2 r^4) grows all the way to the picture's
// farthest corner.
void checkLens(const TextReader& file,
               const v1::Projector& in,
               const Projector& lens,
               glm::dvec2 sizePixels) {
    if (lens.distortion == BrownLens<double>{}) return;
    double farthest = 0;
    for (const glm::dvec2 corner :
         {glm::dvec2(0), glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(1)})
        farthest = std::max(
            farthest, glm::length((corner * sizePixels - lens.principalPixels) / lens.focalPixels));
    constexpr int kSteps = 200;
    double thrown = 0;
    for (int i = 1; thrown < farthest && i <= 10 * kSteps; ++i) {
        const double square = std::pow(farthest * i / kSteps, 2);
        if (lens.distortion.growth(square) <= 0)
            file.refuse(in,
                        "k1",
                        "the lens folds its picture before the farthest corner: k1 and k2 are for "
                        "tangents, not pixels; make them smaller");
        thrown = std::sqrt(square) * lens.distortion.stretch(square);
    }
}

Panel panelOf(const v1::Panel& in) {
    return {.positionMetres = positionOf(in.position()),
            .yawPitchRollRadians = {in.yaw_deg() * kDegree,
                                    in.pitch_deg() * kDegree,
                                    in.roll_deg() * kDegree},
            .sizeMetres = {in.width_m(), in.height_m()},
            .bezelMetres = in.bezel_m()};
}

void checkDevice(const TextReader& file, const v1::Display& in) {
    const std::string_view device = in.device();
    const std::string_view numbered = "device:";
    const bool known =
        device == "auto" || device == "nvidia" || device == "mesa" || device == "surfaceless" ||
        (device.starts_with(numbered) && isAll(device.substr(numbered.size()), "0123456789") &&
         device.size() <= numbered.size() + 3);
    if (!known)
        file.refuse(in,
                    "device",
                    "unknown device \"" + in.device() +
                        "\": write auto, nvidia, mesa, surfaceless or device:N");
}

// Former rigs counted monitors; the count shifts when one is off.
void refuseCounted(const TextReader& file, const v1::Display& in, const std::string& machine) {
    if (!in.has_monitor()) return;
    const std::string where = machine.empty()
                                  ? "this machine has " + namesOf(machine::connectedMonitors())
                                  : "xrandr on machine " + machine + " lists them";
    file.refuse(in,
                "monitor",
                "monitor: " + std::to_string(in.monitor()) +
                    " counts monitors, and means another one when one is off: name the connector, "
                    "as connector: \"HDMI-1\"; " +
                    where);
}

Display displayOf(const TextReader& file, const v1::Display& in) {
    constexpr std::size_t kMostConnectorBytes = 32;
    checkDevice(file, in);
    if (in.connector().size() > kMostConnectorBytes)
        file.refuse(in, "connector", "connector is longer than any: write as xrandr lists it");
    Display display{
        .mode = in.mode() == v1::Display::WINDOW ? DisplayMode::Window : DisplayMode::Fullscreen,
        .connector = machine::connectorName(in.connector()),
        .windowPosition = {in.window_x_px(), in.window_y_px()},
        .device = in.device()};
    if (in.has_refresh_hz()) display.refreshHertz = in.refresh_hz();
    if (in.has_stereo()) display.stereo = modeOf(in.stereo());
    if (in.has_swap_eyes()) display.swapEyes = in.swap_eyes();
    return display;
}

// Both eyes must get as many pixels.
void refuseOddHalves(const TextReader& file, const v1::Channel& in, StereoMode mode) {
    if (mode == StereoMode::SideBySide && in.width_px() % 2 != 0)
        file.refuse(in, "width_px", "width_px is odd: SIDE_BY_SIDE gives each eye half of it");
    if (mode == StereoMode::TopBottom && in.height_px() % 2 != 0)
        file.refuse(in, "height_px", "height_px is odd: TOP_BOTTOM gives each eye half of it");
}

Channel channelOf(const TextReader& file, const v1::Channel& in, const Stereo& stereo) {
    if (!isAll(in.name(), "abcdefghijklmnopqrstuvwxyz0123456789_-") || in.name().size() > 32)
        file.refuse(in,
                    "name",
                    "channel name \"" + in.name() +
                        "\" also names files: use up to 32 of a-z, 0-9, _ and -");
    refuseCounted(file, in.display(), in.machine());
    Channel channel{.id = in.id(),
                    .name = in.name(),
                    .sizePixels = sizeOf(in),
                    .projector = {},
                    .display = displayOf(file, in.display()),
                    .machine = in.machine(),
                    .place = file.placeOf(in)};
    const bool isProjected = in.has_projector() || in.has_wall_file();
    if (isProjected == in.has_panel())
        file.refuse(
            in,
            "channel \"" + in.name() +
                "\" needs a projector, a wall_file or both, or else a panel: what shows it");
    if (in.has_projector()) {
        channel.projector = projectorOf(in.projector(), sizeOf(in));
        checkLens(file, in.projector(), channel.projector, sizeOf(in));
    }
    if (in.has_panel()) channel.panel = panelOf(in.panel());
    if (in.has_wall_file())
        channel.wallFile = {in.wall_file().file(),
                            in.wall_file().has_region() ? in.wall_file().region() : in.name(),
                            in.wall_file().frustum()};
    refuseOddHalves(file, in, channel.display.stereo.value_or(stereo.mode));
    return channel;
}

std::string monitorText(const std::string& connector) {
    return connector.empty() ? "the only monitor" : "connector \"" + connector + "\"";
}

void refuseOverlaps(const TextReader& file, const v1::Rig& in) {
    std::set<std::uint32_t> ids;
    std::set<std::string> names;
    std::set<std::pair<std::string, std::string>> monitors;  // machine and connector
    for (const v1::Channel& channel : in.channels()) {
        const auto giveOwn = ": give \"" + channel.name() + "\" its own";
        if (!ids.insert(channel.id()).second)
            file.refuse(
                channel,
                "id",
                "id " + std::to_string(channel.id()) + " is taken by another channel" + giveOwn);
        if (!names.insert(channel.name()).second)
            file.refuse(
                channel,
                "name",
                "name \"" + channel.name() + "\" is taken by another channel: give each its own");
        const v1::Display& display = channel.display();
        const bool isWhole = display.mode() == v1::Display::FULLSCREEN;
        const std::string connector = machine::connectorName(display.connector());
        if (isWhole && !monitors.emplace(channel.machine(), connector).second)
            file.refuse(display,
                        "connector",
                        monitorText(connector) + " already shows another channel" + giveOwn);
    }
}

// The screen of projectors; panels are their own.
void takeScreen(const TextReader& file, const std::string& source, const v1::Rig& in, Rig& rig) {
    const auto isPanel = [](const Channel& channel) { return channel.panel.has_value(); };
    if (std::ranges::all_of(rig.channels, isPanel)) {
        rig.screen.shape = ScreenShape::Panels;
        rig.screen.hidesBezels = in.bezels() == v1::Rig::HIDDEN;
        if (in.has_screen()) file.refuse(in.screen(), "all channels are panels: remove the screen");
        return;
    }
    const auto panel = std::ranges::find_if(rig.channels, isPanel);
    if (panel != rig.channels.end())
        throw Error(
            placed(source,
                   panel->place,
                   "a rig has panels or projectors, not both: give the panels a rig of their own"));
    file.require(in, "screen");
    rig.screen = screenOf(file, in.screen());
}

// Makes room for a file that the rig names; nodes are told the name.
void nameFile(Rig& rig, const std::string& name, const std::string& source, SourcePlace place) {
    constexpr std::size_t kMostNameBytes = 255;
    const bool isPrintable = std::ranges::none_of(
        name, [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; });
    if (!isPrintable || name.size() > kMostNameBytes)
        throw Error(placed(source,
                           place,
                           "the name of a file has control characters or more than 255 bytes: "
                           "rename the file"));
    rig.files[name] = std::make_shared<const std::vector<std::byte>>();
}

// What a calibration says of all channels that have no wall file of their own.
void takeCalibration(const TextReader& file, const v1::Rig& in, Rig& rig) {
    if (!in.has_calibration()) return;
    if (rig.screen.shape == ScreenShape::Panels)
        file.refuse(in, "calibration", "panels need no calibration: remove it");
    rig.calibration = in.calibration();
    for (Channel& channel : rig.channels)
        if (!channel.wallFile) channel.wallFile = {in.calibration(), channel.name, ""};
}

void takeAdjustments(const TextReader& file,
                     const std::string& source,
                     const v1::Rig& in,
                     Rig& rig) {
    if (!in.has_adjustments()) return;
    if (rig.screen.shape == ScreenShape::Panels)
        file.refuse(in, "adjustments", "adjustments are of projectors, not of panels: remove them");
    rig.adjustments = in.adjustments();
    nameFile(rig, rig.adjustments, source, file.placeOf(in, "adjustments"));
}

void nameFiles(Rig& rig, const std::string& source) {
    if (rig.screen.shape == ScreenShape::Measured)
        nameFile(rig, rig.screen.meshFile, source, rig.screen.place);
    for (const Channel& channel : rig.channels) {
        if (!channel.wallFile) continue;
        nameFile(rig, channel.wallFile->file, source, channel.place);
        if (!channel.wallFile->frustum.empty())
            nameFile(rig, channel.wallFile->frustum, source, channel.place);
    }
}

}  // namespace

std::string nameOf(StereoMode mode) {
    return v1::Stereo::Mode_Name(static_cast<int>(mode) + v1::Stereo::MONO);
}

Rig parseRig(const std::string& text, const std::string& source) {
    v1::Rig in;
    TextReader file(text, source, in);
    file.check();
    checkNetwork(file, in.network());
    if (in.has_standby()) checkStandby(file, in);
    Rig rig{.text = text,
            .name = in.name(),
            .screen = {},
            .panoramaPixels = sizeOf(in.panorama()),
            .controlAddress = in.network().control(),
            .stateAddress = in.network().state(),
            .metricsPort = static_cast<std::uint16_t>(in.network().metrics_port()),
            .consolePort = static_cast<std::uint16_t>(in.network().console_port()),
            .sides = {.watch = in.network().watch(), .depot = in.network().depot()},
            .windowsEndShow = in.windows_end_show(),
            .cues = {},
            .channels = {},
            .timing = timingOf(file, in.timing()),
            .scene = in.scene(),
            .stereo = {.mode = modeOf(in.stereo().mode()),
                       .eyeSeparationMetres = in.stereo().eye_separation_m(),
                       .swapEyes = in.stereo().swap_eyes()},
            .sweetSpotMetres = positionOf(in.sweet_spot()),
            .quality = qualityOf(in),
            .calibration = {},
            .adjustments = {},
            .files = {}};
    rig.places.scene = file.placeOf(in, "scene");
    if (in.has_sweet_spot()) rig.places.sweetSpot = file.placeOf(in.sweet_spot());
    if (in.has_touch()) rig.places.touch = file.placeOf(in.touch());
    for (const v1::Channel& channel : in.channels())
        rig.channels.push_back(channelOf(file, channel, rig.stereo));
    takeVisitors(file, in, rig);
    if (in.has_standby()) rig.standby = standbyOf(in.standby());
    takeScreen(file, source, in, rig);
    takeCalibration(file, in, rig);
    takeAdjustments(file, source, in, rig);
    nameFiles(rig, source);
    refuseOverlaps(file, in);
    return rig;
}

void readRigFiles(Rig& rig, const std::string& rigPath) {
    for (auto& [name, content] : rig.files)
        content = std::make_shared<const std::vector<std::byte>>(
            readWhole(besideFile(rigPath, name), kMostWallFileBytes));
}

Rig readRig(const std::string& path) {
    Rig rig = parseRig(readTextFile(path), path);
    readRigFiles(rig, path);
    return rig;
}

Rig readRigAsHung(const std::string& path) {
    Rig rig = parseRig(readTextFile(path), path);
    for (Channel& channel : rig.channels) {
        if (channel.panel || channel.projector.focalPixels.x == 0)
            throw Error(placed(
                path,
                channel.place,
                "channel \"" + channel.name + "\" has no projector: say where it hangs, about"));
        channel.wallFile.reset();
    }
    rig.files.clear();
    rig.calibration.clear();
    rig.adjustments.clear();
    nameFiles(rig, path);
    readRigFiles(rig, path);
    return rig;
}

bool needsKeys(const Rig& rig) {
    return !isLoopback(hostOf(rig.controlAddress));
}

std::string scenePathOf(const Rig& rig, const std::string& rigPath) {
    std::string path = besideFile(rigPath, rig.scene);
    if (!std::filesystem::is_regular_file(path))
        throw Error(
            placed(rigPath,
                   rig.places.scene,
                   "there is no scene file " + path + ": give its path from the rig's folder"));
    return path;
}

}  // namespace aquarama::config
