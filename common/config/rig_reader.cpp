// SPDX-License-Identifier: Apache-2.0
#include <charconv>
#include <set>
#include <string_view>

#include "common/config/angle.h"
#include "common/config/rig.h"
#include "common/config/rig.pb.h"
#include "common/config/stereo_names.h"
#include "common/config/text_reader.h"

namespace aquarama::config {

namespace {

constexpr Range kPixels{1, 16384};  // what GL 4.5 allows for a texture
constexpr Range kMetres{-1000, 1000};
constexpr Range kTurn{-360, 360};
constexpr Range kShift{-65536, 65536};
constexpr Range kHertz{1, 1000};
constexpr int kMostChannels = 64;

bool isAll(std::string_view text, std::string_view allowed) {
    return !text.empty() && text.find_first_not_of(allowed) == std::string_view::npos;
}

std::optional<int> wholeNumber(std::string_view text) {
    int value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
    return value;
}

bool isLoopback(std::string_view host) {
    return host == "localhost" || host == "[::1]" ||
           (host.starts_with("127.") && isAll(host, "0123456789."));
}

// Without keys anyone in reach could steer the wall, so nothing listens past this machine.
std::string readAddress(const TextPlace& network, const std::string& field) {
    std::string address = network.text(field);
    const std::string_view scheme = "tcp://";
    const std::size_t colon = address.rfind(':');
    if (!address.starts_with(scheme) || colon < scheme.size())
        network.refuse(field,
                       field + " \"" + address + "\" is no address: write tcp://127.0.0.1:PORT");
    const std::optional<int> port = wholeNumber(std::string_view(address).substr(colon + 1));
    if (!port || *port < 1 || *port > 65535)
        network.refuse(field, field + " \"" + address + "\" needs a port from 1 to 65535");
    if (!isLoopback(std::string_view(address).substr(scheme.size(), colon - scheme.size())))
        network.refuse(field,
                       field + " \"" + address +
                           "\" listens past this machine, which needs keys that do not exist yet: "
                           "use tcp://127.0.0.1:" +
                           std::to_string(*port));
    return address;
}

void readNetwork(const TextPlace& network, Rig& rig) {
    rig.controlAddress = readAddress(network, "control");
    rig.stateAddress = readAddress(network, "state");
    const auto port = [](const std::string& address) { return address.substr(address.rfind(':')); };
    if (port(rig.controlAddress) == port(rig.stateAddress))
        network.refuse("state", "state and control share one port: give each its own");
}

glm::ivec2 readSize(const TextPlace& at) {
    return {static_cast<int>(at.number("width_px", kPixels)),
            static_cast<int>(at.number("height_px", kPixels))};
}

Screen readScreen(const TextPlace& at) {
    Screen screen;
    screen.radiusMetres = at.number("radius_m", {0.1, 1000});
    screen.arcRadians = radiansOf(at.number("arc_deg", {1, 180}));
    screen.heightMetres = at.number("height_m", {0.1, 1000});
    screen.place = at.place();
    return screen;
}

Timing readTiming(const TextPlace& at) {
    Timing timing;
    timing.refreshHertz = at.numberOr("refresh_hz", kHertz, timing.refreshHertz);
    timing.presentDeadlineSeconds =
        at.numberOr("present_deadline_s", {0.001, 60}, 1 / timing.refreshHertz);
    timing.membershipSeconds = at.numberOr("membership_s", {0.01, 600}, timing.membershipSeconds);
    if (timing.membershipSeconds < timing.presentDeadlineSeconds)
        at.refuse("membership_s",
                  "membership_s is shorter than present_deadline_s, so that every late frame would "
                  "cost a node its place: make it longer");
    return timing;
}

glm::dvec3 readPosition(const TextPlace& position) {
    return {position.number("x_m", kMetres),
            position.number("y_m", kMetres),
            position.number("z_m", kMetres)};
}

StereoMode readStereoMode(const TextPlace& at, const std::string& field) {
    for (const auto& [name, mode] : kStereoModes)
        if (at.choice(field) == name) return mode;
    at.refuse(field,
              field + " is " + at.choice(field) +
                  ": write MONO, QUAD_BUFFER, SIDE_BY_SIDE, TOP_BOTTOM, INTERLACED or ANAGLYPH");
}

Stereo readStereo(const TextPlace& at) {
    Stereo stereo;
    stereo.mode = readStereoMode(at, "mode");
    stereo.eyeSeparationMetres =
        at.numberOr("eye_separation_m", {0, 1}, stereo.eyeSeparationMetres);
    if (at.has("swap_eyes")) stereo.swapEyes = at.truth("swap_eyes");
    return stereo;
}

// Both eyes must get as many pixels.
void refuseOddHalves(const TextPlace& at, const Rig& rig, const Channel& channel) {
    const StereoMode mode = channel.display.stereo.value_or(rig.stereo.mode);
    if (mode == StereoMode::SideBySide && channel.sizePixels.x % 2 != 0)
        at.refuse("width_px", "width_px is odd: SIDE_BY_SIDE gives each eye half of it");
    if (mode == StereoMode::TopBottom && channel.sizePixels.y % 2 != 0)
        at.refuse("height_px", "height_px is odd: TOP_BOTTOM gives each eye half of it");
}

std::optional<QualityTier> readQuality(const TextPlace& at) {
    if (!at.has("quality")) return std::nullopt;
    std::string choice = at.choice("quality");
    if (choice == "MEASURED") return std::nullopt;
    std::ranges::transform(
        choice, choice.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? c + ('a' - 'A') : c; });
    const auto tier = tierNamed(choice);
    if (!tier) at.refuse("quality", "write MEASURED, LOW, MEDIUM, HIGH or ULTRA");
    return tier;
}

Projector readProjector(const TextPlace& at, glm::dvec2 sizePixels) {
    Projector projector;
    projector.positionMetres = readPosition(at.in("position"));
    projector.yawPitchRollRadians = {radiansOf(at.numberOr("yaw_deg", kTurn, 0)),
                                     radiansOf(at.numberOr("pitch_deg", kTurn, 0)),
                                     radiansOf(at.numberOr("roll_deg", kTurn, 0))};
    projector.focalPixels = {at.number("focal_x_px", {1, 1e6}), at.number("focal_y_px", {1, 1e6})};
    projector.principalPixels = {at.numberOr("principal_x_px", kShift, sizePixels.x / 2),
                                 at.numberOr("principal_y_px", kShift, sizePixels.y / 2)};
    return projector;
}

std::string readDevice(const TextPlace& at) {
    if (!at.has("device")) return "auto";
    std::string device = at.text("device");
    const std::string_view numbered = "device:";
    const bool known = device == "auto" || device == "nvidia" || device == "mesa" ||
                       device == "surfaceless" ||
                       (device.starts_with(numbered) &&
                        isAll(std::string_view(device).substr(numbered.size()), "0123456789") &&
                        device.size() <= numbered.size() + 3);
    if (!known)
        at.refuse(
            "device",
            "unknown device \"" + device + "\": write auto, nvidia, mesa, surfaceless or device:N");
    return device;
}

Display readDisplay(const TextPlace& at) {
    Display display;
    const std::string mode = at.choice("mode");
    if (mode != "WINDOW" && mode != "FULLSCREEN")
        at.refuse("mode", "mode is " + mode + ": write WINDOW or FULLSCREEN");
    display.mode = mode == "WINDOW" ? DisplayMode::Window : DisplayMode::Fullscreen;
    display.monitor = static_cast<int>(at.numberOr("monitor", {0, 63}, 0));
    display.windowPosition = {static_cast<int>(at.numberOr("window_x_px", kShift, 0)),
                              static_cast<int>(at.numberOr("window_y_px", kShift, 0))};
    display.device = readDevice(at);
    if (at.has("refresh_hz")) display.refreshHertz = at.number("refresh_hz", kHertz);
    if (at.has("stereo")) display.stereo = readStereoMode(at, "stereo");
    if (at.has("swap_eyes")) display.swapEyes = at.truth("swap_eyes");
    return display;
}

Channel readChannel(const TextPlace& at) {
    Channel channel;
    channel.id = static_cast<std::uint32_t>(at.number("id", {0, 4294967295.0}));
    channel.name = at.text("name");
    if (!isAll(channel.name, "abcdefghijklmnopqrstuvwxyz0123456789_-") || channel.name.size() > 32)
        at.refuse("name",
                  "channel name \"" + channel.name +
                      "\" also names files: use up to 32 of a-z, 0-9, _ and -");
    channel.sizePixels = readSize(at);
    channel.projector = readProjector(at.in("projector"), channel.sizePixels);
    channel.display = readDisplay(at.in("display"));
    channel.place = at.place();
    return channel;
}

void refuseOverlaps(const TextPlace& root, const std::vector<Channel>& channels) {
    std::set<std::uint32_t> ids;
    std::set<std::string> names;
    std::set<int> monitors;
    for (std::size_t i = 0; i < channels.size(); ++i) {
        const TextPlace at = root.in("channels", static_cast<int>(i));
        const Channel& channel = channels[i];
        if (!ids.insert(channel.id).second)
            at.refuse("id",
                      "id " + std::to_string(channel.id) + " is taken by another channel: give \"" +
                          channel.name + "\" its own");
        if (!names.insert(channel.name).second)
            at.refuse(
                "name",
                "name \"" + channel.name + "\" is taken by another channel: give each its own");
        if (channel.display.mode == DisplayMode::Fullscreen &&
            !monitors.insert(channel.display.monitor).second)
            at.in("display").refuse("monitor",
                                    "monitor " + std::to_string(channel.display.monitor) +
                                        " already shows another channel: give \"" + channel.name +
                                        "\" its own");
    }
}

std::vector<Channel> readChannels(const TextPlace& root) {
    const int count = root.count("channels");
    if (count < 1) root.refuse("the rig has no channels: add one for each projector");
    if (count > kMostChannels)
        root.refuse("channels",
                    "more than " + std::to_string(kMostChannels) + " channels: split the rig",
                    kMostChannels);
    std::vector<Channel> channels;
    channels.reserve(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) channels.push_back(readChannel(root.in("channels", i)));
    refuseOverlaps(root, channels);
    return channels;
}

}  // namespace

Rig parseRig(const std::string& text, const std::string& source) {
    v1::Rig message;
    const TextReader reader(text, source, message);
    const TextPlace root = reader.root();
    Rig rig;
    rig.name = root.text("name");
    rig.screen = readScreen(root.in("screen"));
    rig.panoramaPixels = readSize(root.in("panorama"));
    readNetwork(root.in("network"), rig);
    rig.timing.presentDeadlineSeconds = 1 / rig.timing.refreshHertz;
    if (root.has("timing")) rig.timing = readTiming(root.in("timing"));
    rig.scene = root.text("scene");
    rig.scenePlace = root.placeOf("scene");
    if (root.has("stereo")) rig.stereo = readStereo(root.in("stereo"));
    if (root.has("sweet_spot")) {
        rig.sweetSpotMetres = readPosition(root.in("sweet_spot"));
        rig.sweetSpotPlace = root.placeOf("sweet_spot");
    }
    rig.quality = readQuality(root);
    rig.channels = readChannels(root);
    for (std::size_t i = 0; i < rig.channels.size(); ++i)
        refuseOddHalves(root.in("channels", static_cast<int>(i)), rig, rig.channels[i]);
    return rig;
}

Rig readRig(const std::string& path) {
    return parseRig(readTextFile(path), path);
}

}  // namespace aquarama::config
