// SPDX-License-Identifier: Apache-2.0
#include "commands/new_rig.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <spdlog/fmt/fmt.h>

#include "common/base/counted.h"
#include "common/base/log.h"
#include "common/base/units.h"

namespace aquarama {

namespace {

constexpr double kMetresAnInch = 0.0254;
constexpr double kOverlap =
    0.2;  // share of a projector's part that overlaps with its neighbours, both together
constexpr int kWindowColumns = 640;

// Names of channels: "left", "middle" and "right" where these are enough.
std::string channelName(int index, int count) {
    if (count == 1) return "middle";
    if (index == 0) return "left";
    if (index == count - 1) return "right";
    return count == 3 ? "middle" : "from_left_" + std::to_string(index + 1);
}

// Size of a television's picture, from its diagonal and pixels.
glm::dvec2 metresOf(double diagonalInches, glm::ivec2 pixels) {
    const glm::dvec2 size(pixels);
    return size * (diagonalInches * kMetresAnInch / glm::length(size));
}

// The reported size of a monitor, where it is plausible: projectors and cheap televisions report
// wrong sizes.
std::optional<glm::dvec2> believableSize(const machine::MonitorFacts& monitor) {
    const glm::dvec2 size = monitor.sizeMetres;
    if (size.x < 0.2 || size.x > 3 || size.y <= 0) return std::nullopt;
    const double shape = size.x / size.y * monitor.sizePixels.y / monitor.sizePixels.x;
    return shape > 0.9 && shape < 1.1 ? std::optional(size) : std::nullopt;
}

const machine::Connector* connectorNamed(const std::vector<machine::Connector>& connected,
                                         const std::string& name) {
    const auto found = std::ranges::find(connected, name, &machine::Connector::name);
    return found == connected.end() ? nullptr : &*found;
}

// The wanted number, or the number of monitors.
int countOf(const NewRigWishes& wishes, std::size_t monitors) {
    if (wishes.count) return *wishes.count;
    if (!wishes.connectors.empty()) return static_cast<int>(wishes.connectors.size());
    return wishes.windows || monitors == 0 ? 3 : static_cast<int>(monitors);
}

void chooseConnectors(NewRigWishes& wishes, const std::vector<machine::Connector>& connected) {
    if (wishes.windows) return wishes.connectors.clear();
    if (wishes.connectors.empty())
        for (const machine::Connector& one : wallMonitors(connected))
            wishes.connectors.push_back(one.name);
    const auto count = static_cast<std::size_t>(*wishes.count);
    if (wishes.connectors.size() < count)
        throw Error(
            fmt::format("{} needed, this machine has {}: connect them and "
                        "switch them on, name them (--monitors), or take windows on this "
                        "desktop (--windows)",
                        counted(count, "monitor") + (count == 1 ? " is" : " are"),
                        namesOf(connected)));
    wishes.connectors.resize(count);
}

PlannedChannel channelOf(const NewRigWishes& wishes,
                         const std::vector<machine::Connector>& connected,
                         int index) {
    PlannedChannel channel;
    channel.name = channelName(index, *wishes.count);
    const machine::Connector* there = nullptr;
    if (!wishes.windows) {
        channel.connector = wishes.connectors[static_cast<std::size_t>(index)];
        there = connectorNamed(connected, channel.connector);
    }
    const bool isKnown = there != nullptr && there->monitor.sizePixels.x > 0;
    channel.sizePixels =
        wishes.sizePixels.value_or(isKnown ? there->monitor.sizePixels : kSizePixels);
    channel.sizeMetres =
        metresOf(wishes.diagonalInches.value_or(kDiagonalInches), channel.sizePixels);
    if (isKnown && !wishes.diagonalInches)
        channel.sizeMetres = believableSize(there->monitor).value_or(channel.sizeMetres);
    if (wishes.windows)
        channel.sizePixels = {
            kWindowColumns,
            std::max(1, kWindowColumns * channel.sizePixels.y / channel.sizePixels.x)};
    return channel;
}

void giveDefault(std::optional<double>& wish, double value) {
    wish = wish.value_or(value);
}

// Fills in the lengths that the kind needs.
void fillIn(NewRigWishes& wishes) {
    switch (*wishes.kind) {
        case WallKind::Televisions:
            giveDefault(wishes.angle, *wishes.count > 1 ? 40 : 0);
            giveDefault(wishes.bezel, 0.01);
            giveDefault(wishes.distance, 1.5);
            return;
        case WallKind::Cylinder:
            giveDefault(wishes.radius, 3);
            giveDefault(wishes.arc, 120);
            giveDefault(wishes.height, 2.4);
            break;
        case WallKind::Flat:
            giveDefault(wishes.width, 6);
            giveDefault(wishes.height, 2);
            giveDefault(wishes.distance, 3);
            break;
    }
    giveDefault(wishes.throwRatio, 1.5);
    giveDefault(wishes.mount, *wishes.height / 2 + 0.3);
}

// Place of a television: the middle of its picture and its direction.
struct StandingTelevision {
    glm::dvec2 place{};  // x and z
    double yawDegrees = 0;
};

// From left to right, edge to edge, each turned from its neighbour by the same angle; the middle is
// straight ahead of the eye.
std::vector<StandingTelevision> stand(const RigPlan& plan) {
    const NewRigWishes& wishes = plan.wishes;
    const auto count = plan.channels.size();
    std::vector<StandingTelevision> row;
    std::vector<glm::dvec2> joints{glm::dvec2(0)};
    for (std::size_t i = 0; i < count; ++i) {
        const double yaw =
            *wishes.angle * (static_cast<double>(count - 1) / 2 - static_cast<double>(i));
        const glm::dvec2 along(std::cos(yaw * kDegree), -std::sin(yaw * kDegree));
        const glm::dvec2 whole = (plan.channels[i].sizeMetres.x + 2 * *wishes.bezel) * along;
        row.push_back({joints.back() + whole / 2.0, yaw});
        joints.push_back(joints.back() + whole);
    }
    const glm::dvec2 middle = count % 2 == 1 ? row[count / 2].place : joints[count / 2];
    for (StandingTelevision& one : row) one.place += glm::dvec2(0, -*wishes.distance) - middle;
    return row;
}

// A projector and its lens, square pixels, level.
struct HungProjector {
    glm::dvec3 position{};
    double yawDegrees = 0;
    double focalPixels = 0;
    double principalRow = 0;
};

// A part of the screen about its own middle: straight ahead is where its projector looks, x to the
// right, and how far in front of that middle each of its points is.
struct ScreenPart {
    double halfWidth = 0;                         // as `at` takes it
    std::function<glm::dvec2(double across)> at;  // x, and metres towards the projector
    double halfHeight = 0;
};

// The lens that covers a part from a distance, with the smallest picture that does.
HungProjector lensFor(const ScreenPart& part, double distance, double mount, glm::dvec2 pixels) {
    constexpr int kSamples = 33;
    constexpr double kReserve = 0.98;  // of the picture
    double side = 0, low = 0, high = -1e9;
    for (int i = 0; i < kSamples; ++i) {
        const glm::dvec2 point = part.at(part.halfWidth * (2.0 * i / (kSamples - 1) - 1));
        const double away = distance - point.y;
        side = std::max(side, std::abs(point.x) / away);
        low = std::min({low, (-part.halfHeight - mount) / away, (part.halfHeight - mount) / away});
        high =
            std::max({high, (-part.halfHeight - mount) / away, (part.halfHeight - mount) / away});
    }
    HungProjector hung;
    hung.focalPixels = kReserve * std::min(pixels.x / (2 * side), pixels.y / (high - low));
    hung.principalRow = pixels.y / 2 + hung.focalPixels * (high + low) / 2;
    return hung;
}

// How far a projector of this throw ratio hangs from a part, between two bounds.
double distanceFor(const ScreenPart& part,
                   const NewRigWishes& wishes,
                   glm::dvec2 pixels,
                   glm::dvec2 bounds) {
    for (int i = 0; i < 60; ++i) {
        const double middle = (bounds.x + bounds.y) / 2;
        const HungProjector hung = lensFor(part, middle, *wishes.mount, pixels);
        (hung.focalPixels / pixels.x < *wishes.throwRatio ? bounds.x : bounds.y) = middle;
    }
    return bounds.x;
}

// By which factor a part is wider than its share: 1 for a single projector.
double widened(std::size_t count) {
    return count > 1 ? 1 + kOverlap : 1;
}

// The place of part `index` along the screen, from its middle, as a share of the whole.
double shareOf(std::size_t index, std::size_t count) {
    return (static_cast<double>(index) + 0.5) / static_cast<double>(count) - 0.5;
}

HungProjector hangBeforeCylinder(const RigPlan& plan, std::size_t index) {
    const NewRigWishes& wishes = plan.wishes;
    const std::size_t count = plan.channels.size();
    const glm::dvec2 pixels(plan.channels[index].sizePixels);
    const double radius = *wishes.radius, arc = *wishes.arc * kDegree;
    const double half = arc / static_cast<double>(count) / 2 * widened(count);
    const ScreenPart part{half,
                          [radius](double angle) {
                              return radius * glm::dvec2(std::sin(angle), 1 - std::cos(angle));
                          },
                          *wishes.height / 2};
    // At least in front of every point of its part, at most before the opposite side of the
    // cylinder.
    const glm::dvec2 bounds(radius * (1.1 - std::cos(half)), 1.9 * radius);
    const double distance = distanceFor(part, wishes, pixels, bounds);
    HungProjector hung = lensFor(part, distance, *wishes.mount, pixels);
    const double azimuth = arc * shareOf(index, count);
    hung.position = {(radius - distance) * std::sin(azimuth),
                     *wishes.mount,
                     -(radius - distance) * std::cos(azimuth)};
    hung.yawDegrees = -azimuth / kDegree;
    return hung;
}

HungProjector hangBeforeWall(const RigPlan& plan, std::size_t index) {
    const NewRigWishes& wishes = plan.wishes;
    const std::size_t count = plan.channels.size();
    const glm::dvec2 pixels(plan.channels[index].sizePixels);
    const double half = *wishes.width / static_cast<double>(count) / 2 * widened(count);
    const ScreenPart part{half, [](double x) { return glm::dvec2(x, 0); }, *wishes.height / 2};
    const double distance = distanceFor(part, wishes, pixels, {0.1, 100 * *wishes.width});
    HungProjector hung = lensFor(part, distance, *wishes.mount, pixels);
    hung.position = {
        *wishes.width * shareOf(index, count), *wishes.mount, distance - *wishes.distance};
    return hung;
}

// Width by height of what the composed pictures show.
double panoramaShape(const RigPlan& plan) {
    const NewRigWishes& wishes = plan.wishes;
    if (*wishes.kind == WallKind::Cylinder)
        return *wishes.radius * *wishes.arc * kDegree / *wishes.height;
    if (*wishes.kind == WallKind::Flat) return *wishes.width / *wishes.height;
    double farthest = 0.01, highest = 0.01;
    const auto row = stand(plan);
    for (std::size_t i = 0; i < row.size(); ++i) {
        const glm::dvec2 size = plan.channels[i].sizeMetres;
        const double yaw = row[i].yawDegrees * kDegree;
        for (const double side : {-0.5, 0.0, 0.5}) {
            const glm::dvec2 edge =
                row[i].place + side * size.x * glm::dvec2(std::cos(yaw), -std::sin(yaw));
            farthest = std::max(farthest, std::abs(std::atan2(edge.x, -edge.y)));
            highest = std::max(highest, std::atan(size.y / 2 / glm::length(edge)));
        }
    }
    return farthest / highest;
}

std::string panoramaText(const RigPlan& plan) {
    constexpr int kColumns = 1500;
    const int rows =
        std::clamp(static_cast<int>(std::lround(kColumns / panoramaShape(plan))), 1, 16384);
    return fmt::format("panorama {{ width_px: {} height_px: {} }}\n", kColumns, rows);
}

std::string screenText(const NewRigWishes& wishes) {
    if (*wishes.kind == WallKind::Televisions)
        return "bezels: KEPT  # the world goes on behind the frames, as behind the bars of a "
               "window; "
               "HIDDEN: the pictures touch\n";
    if (*wishes.kind == WallKind::Flat)
        return fmt::format(
            "screen {{ flat {{ width_m: {:.3f} height_m: {:.3f} distance_m: {:.3f} }} }}\n",
            *wishes.width,
            *wishes.height,
            *wishes.distance);
    return fmt::format(
        "screen {{\n"
        "  radius_m: {:.3f}  # of the circle that the screen is a piece of\n"
        "  arc_deg: {:.2f}   # half of it to each side of straight ahead\n"
        "  height_m: {:.3f}  # half above and half below the eye\n"
        "}}\n",
        *wishes.radius,
        *wishes.arc,
        *wishes.height);
}

// Rounds to the written digits, and never gives -0.
double rounded(double value) {
    return std::round(value * 1e4) / 1e4 + 0.0;
}

std::string displayText(const RigPlan& plan, std::size_t index) {
    const PlannedChannel& channel = plan.channels[index];
    if (!channel.connector.empty())
        return fmt::format("  display {{ mode: FULLSCREEN connector: \"{}\" }}\n",
                           channel.connector);
    return fmt::format("  display {{ mode: WINDOW window_x_px: {} window_y_px: 0 }}\n",
                       kWindowColumns * index);
}

std::string panelText(const RigPlan& plan, std::size_t index) {
    const StandingTelevision place = stand(plan)[index];
    const glm::dvec2 size = plan.channels[index].sizeMetres;
    return fmt::format(
        "  panel {{\n"
        "    position {{ x_m: {:.4f} y_m: 0 z_m: {:.4f} }}\n"
        "    yaw_deg: {:.2f}\n"
        "    width_m: {:.4f}\n"
        "    height_m: {:.4f}\n"
        "    bezel_m: {:.4f}\n"
        "  }}\n",
        rounded(place.place.x),
        rounded(place.place.y),
        rounded(place.yawDegrees),
        size.x,
        size.y,
        *plan.wishes.bezel);
}

std::string projectorText(const RigPlan& plan, std::size_t index) {
    const bool isCurved = *plan.wishes.kind == WallKind::Cylinder;
    const HungProjector hung = (isCurved ? hangBeforeCylinder : hangBeforeWall)(plan, index);
    return fmt::format(
        "  projector {{\n"
        "    position {{ x_m: {:.4f} y_m: {:.4f} z_m: {:.4f} }}\n"
        "    yaw_deg: {:.3f}\n"
        "    focal_x_px: {:.2f}  # throw ratio {:.2f}, times the columns\n"
        "    focal_y_px: {:.2f}\n"
        "    principal_y_px: {:.2f}  # lens shift: the row that the lens axis meets\n"
        "  }}\n",
        rounded(hung.position.x),
        rounded(hung.position.y),
        rounded(hung.position.z),
        rounded(hung.yawDegrees),
        hung.focalPixels,
        hung.focalPixels / plan.channels[index].sizePixels.x,
        hung.focalPixels,
        hung.principalRow);
}

std::string headText(const RigPlan& plan) {
    const bool isTelevisions = *plan.wishes.kind == WallKind::Televisions;
    return fmt::format(
        "# {} {}, as aquarama new-rig was told of them. All of it may be changed by hand: "
        "aquarama\n"
        "# check says whether it still holds, and docs/reference.md what each line means.\n"
        "#\n"
        "# Metres from the eye of somebody who stands where the picture is right; x to the right, "
        "y\n"
        "# up, z back, away from the wall. Degrees; pixels from a picture's top left.\n{}",
        plan.channels.size(),
        isTelevisions ? "televisions" : "projectors",
        isTelevisions ? ""
                      : "#\n# Projectors hang about as they are said to here: aquarama calibrate "
                        "finds the rest by camera.\n");
}

// The rig's timing. Windows get long deadlines, since a processor may draw them.
std::string timingText(bool windows) {
    return windows ? "# A machine without a graphics card takes a while for a frame: nobody is "
                     "hurried.\ntiming { refresh_hz: 60 present_deadline_s: 2 membership_s: 5 }\n"
                   : "timing { refresh_hz: 60 membership_s: 1 }\n";
}

std::string channelText(const RigPlan& plan, std::size_t index) {
    const PlannedChannel& channel = plan.channels[index];
    const bool isTelevision = *plan.wishes.kind == WallKind::Televisions;
    return fmt::format(
               "\nchannels {{\n"
               "  id: {}\n"
               "  name: \"{}\"\n"
               "  width_px: {}\n"
               "  height_px: {}\n",
               index,
               channel.name,
               channel.sizePixels.x,
               channel.sizePixels.y) +
           (isTelevision ? panelText : projectorText)(plan, index) + displayText(plan, index) +
           "}\n";
}

}  // namespace

std::vector<machine::Connector> wallMonitors(std::vector<machine::Connector> connected) {
    const auto isPanel = [](const machine::Connector& one) { return machine::isBuiltIn(one.name); };
    if (!std::ranges::all_of(connected, isPanel)) std::erase_if(connected, isPanel);
    return connected;
}

double usualDiagonal(const std::vector<machine::Connector>& monitors) {
    for (const machine::Connector& one : monitors)
        if (const auto size = believableSize(one.monitor))
            return std::round(glm::length(*size) / kMetresAnInch);
    return kDiagonalInches;
}

RigPlan planOf(NewRigWishes wishes,
               const std::vector<machine::Connector>& connected,
               const std::string& name) {
    RigPlan plan{.name = name, .wishes = std::move(wishes), .channels = {}};
    plan.wishes.kind = plan.wishes.kind.value_or(WallKind::Televisions);
    plan.wishes.count = countOf(plan.wishes, wallMonitors(connected).size());
    chooseConnectors(plan.wishes, connected);
    fillIn(plan.wishes);
    for (int i = 0; i < *plan.wishes.count; ++i)
        plan.channels.push_back(channelOf(plan.wishes, connected, i));
    return plan;
}

std::string textOf(const RigPlan& plan) {
    const bool isDesk = plan.wishes.windows || *plan.wishes.kind == WallKind::Televisions;
    std::string text =
        headText(plan) + "\n" + fmt::format("version: 2\nname: \"{}\"\n\n", plan.name) +
        screenText(plan.wishes) +
        "\n# The whole wall in one picture, for --snapshot and the console.\n" +
        panoramaText(plan) +
        "\n# Where the processes meet, on this machine; another rig on it needs other ports.\n"
        "network {\n"
        "  control: \"tcp://127.0.0.1:7400\"\n"
        "  state: \"tcp://127.0.0.1:7401\"\n"
        "  console_port: 7480  # the operator's console, where it is installed: "
        "http://127.0.0.1:7480\n"
        "  watch: \"tcp://127.0.0.1:7402\"\n"
        "}\n\n" +
        timingText(plan.wishes.windows) +
        fmt::format(
            "\nscene: \"{}\"  # what is shown\n"
            "\n# Whether q and Esc in a window end the show: on a desk, not in a hall.\n"
            "windows_end_show: {}\n",
            plan.wishes.scene,
            isDesk);
    for (std::size_t i = 0; i < plan.channels.size(); ++i) text += channelText(plan, i);
    return text;
}

}  // namespace aquarama
