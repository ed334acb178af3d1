// SPDX-License-Identifier: Apache-2.0
// Checks that the channels of a rig form a wall.
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "common/base/log.h"
#include "common/base/units.h"
#include "common/wall/wall.h"

namespace aquarama::wall {

namespace {

// The samples of the screen that checkCovered() looks at.
constexpr int kColumns = 481;
constexpr int kRows = 121;
// Beyond this a flat picture would need very many pixels at its sides.
constexpr double kWidestDegrees = 150;

[[noreturn]] void refuse(const std::string& source,
                         config::SourcePlace place,
                         const std::string& why) {
    throw Error(config::placed(source, place, why));
}

std::string oneDecimal(double value) {
    return fmt::format("{:.1f}", value);
}

// As in "12.0 degrees left", "3.5 degrees right".
std::string sideways(double azimuth) {
    return oneDecimal(std::abs(azimuth) / kRadiansPerDegree<double>) + " degrees " +
           (azimuth < 0 ? "left" : "right");
}

// The error for a channel that lights nothing of the screen.
[[noreturn]] void refuseMiss(const config::Channel& channel, const std::string& source) {
    if (channel.wallFile)
        refuse(source,
               channel.place,
               channel.wallFile->file + " lights nothing of the screen for channel \"" +
                   channel.name + "\": see whether its region, unit and frame are this screen's");
    refuse(source,
           channel.place,
           "projector \"" + channel.name +
               "\" misses the screen: aim it by yaw_deg, pitch_deg and principal_y_px, or move it");
}

// A channel must light some of the screen, and not too wide a part.
void checkChannel(const config::Rig& rig,
                  const Wall& wall,
                  std::size_t index,
                  const std::string& source) {
    const config::Channel& channel = rig.channels[index];
    const std::vector<glm::dvec3> lit = wall.channel(index).outline(0);
    if (lit.empty()) refuseMiss(channel, source);
    const bool isUpright =
        rig.screen.shape == config::ScreenShape::Cylinder && rig.screen.tiltRadians == 0;
    if (!isUpright) return;  // by the view of checkEyes()
    const auto [low, high] = std::ranges::minmax(lit, {}, azimuthOf);
    if (azimuthOf(high) - azimuthOf(low) > kWidestDegrees * kRadiansPerDegree<double>)
        refuse(source,
               channel.place,
               "projector \"" + channel.name + "\" lights more than " + oneDecimal(kWidestDegrees) +
                   " degrees of the screen: give it a longer focal_x_px, or share with another");
}

// Where sample `index` of `count` is between the edges of what has to be lit, as a share of the
// screen.
double sample(int index, int count) {
    return kDarkBorder + (1 - 2 * kDarkBorder) * index / (count - 1);
}

bool isLit(const Wall& wall, glm::dvec3 point) {
    for (std::size_t channel = 0; channel < wall.channels(); ++channel)
        if (wall.channel(channel).pixelOf(point)) return true;
    return false;
}

// Calls visit(point, whether it is lit, column) for samples of the screen, column by column.
void walkScreen(const Wall& wall, const std::function<void(glm::dvec3, bool, int)>& visit) {
    for (int column = 0; column < kColumns; ++column)
        for (int row = 0; row < kRows; ++row) {
            const auto point = wall.screen().at({sample(column, kColumns), sample(row, kRows)});
            if (point) visit(*point, isLit(wall, *point), column);
        }
}

// The first run of neighbouring columns that have a dark point.
struct Hole {
    std::vector<glm::dvec3> points;
    int first = 0, last = 0;  // columns
};

Hole firstHole(const Wall& wall) {
    Hole hole;
    walkScreen(wall, [&](glm::dvec3 point, bool isLit, int column) {
        if (isLit || (!hole.points.empty() && column > hole.last + 1)) return;
        if (hole.points.empty()) hole.first = column;
        hole.last = column;
        hole.points.push_back(point);
    });
    return hole;
}

// The middle of a hole in a screen that surrounds the eye.
std::string aroundMiddle(const Hole& hole) {
    glm::dvec3 sum(0);
    for (const glm::dvec3& point : hole.points) sum += point;
    return "about " + sideways(azimuthOf(sum)) + ", " +
           oneDecimal(elevationOf(sum) / kRadiansPerDegree<double>) + " degrees up";
}

// All samples of the screen must be lit.
void checkCovered(const config::Rig& rig, const Wall& wall, const std::string& source) {
    const Hole hole = firstHole(wall);
    if (hole.points.empty()) return;
    const std::string remedy =
        ": aim one there, shorten its focal length, or make the screen smaller";
    if (rig.screen.shape == config::ScreenShape::Dome)
        refuse(source,
               rig.screen.place,
               "no projector lights the screen " + aroundMiddle(hole) + remedy);
    const auto [low, high] = std::ranges::minmax(hole.points, {}, &glm::dvec3::y);
    const bool fullHeight = low.y < 0 && high.y > 0;
    const bool reachesEdge = hole.first == 0 || hole.last == kColumns - 1;
    const std::string where = "from " + sideways(azimuthOf(hole.points.front())) + " to " +
                              sideways(azimuthOf(hole.points.back())) + " of the middle, " +
                              oneDecimal(low.y) + " to " + oneDecimal(high.y) +
                              " m above the sweet spot";
    if (fullHeight && !reachesEdge)
        refuse(source,
               rig.screen.place,
               "neighbours leave a gap " + where +
                   ": turn them together, or shorten their focal_x_px");
    refuse(source, rig.screen.place, "no projector lights the screen " + where + remedy);
}

// The eyes must be in front of the screen, not beside or behind a part of it, and see no channel so
// wide that its picture would need very many pixels.
void checkEyes(const config::Rig& rig, const Wall& wall, const std::string& source) {
    constexpr double kWidest = kWidestDegrees * kRadiansPerDegree<double>;
    for (std::size_t channel = 0; channel < rig.channels.size(); ++channel)
        for (const EyeSide eye : {EyeSide::Left, EyeSide::Right}) try {
                const ChannelFrustum seen = wall.frustum(channel, 0, eye);
                const double across = std::atan(seen.right) - std::atan(seen.left);
                const double upright = std::atan(seen.top) - std::atan(seen.bottom);
                if (std::max(across, upright) > kWidest)
                    throw Error(
                        "channel \"" + rig.channels[channel].name + "\" spans more than " +
                        oneDecimal(kWidestDegrees) +
                        " degrees of the view: share with another, or move sweet_spot back");
            } catch (const Error& error) {
                const bool isElsewhere = rig.places.sweetSpot.line > 0;
                refuse(source,
                       isElsewhere ? rig.places.sweetSpot : rig.channels[channel].place,
                       error.what());
            }
}

// Hands are before the viewer: no corner of their surface is 60 degrees and more beside the screen.
// Of people the floor may reach behind the viewer.
void checkTouch(const config::Rig& rig, const Wall& wall, const std::string& source) {
    if (!rig.touch || rig.touch->peopleReachMetres) return;
    constexpr double kAside = 0.5;  // cosine
    const glm::dvec3 eye = eyePosition(rig, EyeSide::Between);
    const std::vector<glm::dvec3> border = wall.screen().border(0);
    const std::array<std::pair<const char*, glm::dvec3>, 3> corners{
        {{"top_left", rig.touch->topLeft},
         {"top_right", rig.touch->topRight},
         {"bottom_left", rig.touch->bottomLeft}}};
    for (const auto& [name, corner] : corners) {
        const auto isAhead = [&, at = corner](glm::dvec3 point) {
            return glm::dot(at - eye, point - eye) >
                   kAside * glm::length(at - eye) * glm::length(point - eye);
        };
        if (std::ranges::none_of(border, isAhead))
            refuse(source,
                   rig.places.touch,
                   std::string(name) +
                       " of touch lies behind the viewer's eye: z_m is negative towards the "
                       "screen");
    }
}

// Measured screens have ragged edges: their dark parts are accepted.
bool isMeasured(const config::Rig& rig) {
    return rig.screen.shape == config::ScreenShape::Measured ||
           std::ranges::any_of(rig.channels, [](const config::Channel& channel) {
               return channel.wallFile.has_value();
           });
}

}  // namespace

double darkShare(const Wall& wall) {
    std::size_t dark = 0, all = 0;
    walkScreen(wall, [&](glm::dvec3, bool isLit, int) {
        ++all;
        if (!isLit) ++dark;
    });
    return static_cast<double>(dark) / static_cast<double>(std::max<std::size_t>(all, 1));
}

void checkGeometry(const config::Rig& rig, const std::string& source) {
    const Wall wall(rig);
    for (std::size_t i = 0; i < rig.channels.size(); ++i) checkChannel(rig, wall, i, source);
    if (!isMeasured(rig)) checkCovered(rig, wall, source);
    checkEyes(rig, wall, source);
    checkTouch(rig, wall, source);
}

}  // namespace aquarama::wall
