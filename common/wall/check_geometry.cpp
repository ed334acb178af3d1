// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/units/angle.h"
#include "common/units/error.h"
#include "common/wall/outline.h"
#include "common/wall/wall.h"

namespace aquarama::wall {

namespace {

constexpr int kColumns = 481;
constexpr int kRows = 121;
constexpr double kWidestDegrees = 150;  // past it a flat picture would need endless pixels

[[noreturn]] void refuse(const std::string& source,
                         config::SourcePlace place,
                         const std::string& why) {
    throw Error(config::placed(source, place, why));
}

std::string oneDecimal(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", value);
    return text;
}

// "12.0 degrees left", "3.5 degrees right"
std::string sideways(double azimuth) {
    return oneDecimal(std::abs(azimuth) / kRadiansPerDegree<double>) + " degrees " +
           (azimuth < 0 ? "left" : "right");
}

void checkProjector(const config::Rig& rig,
                    const config::Channel& channel,
                    const std::string& source) {
    const std::vector<glm::dvec3> lit = litOutline(rig.screen, Pinhole(channel), 0);
    if (lit.empty())
        refuse(source,
               channel.place,
               "projector \"" + channel.name +
                   "\" misses the screen: aim it by yaw_deg, pitch_deg and principal_y_px, or "
                   "move it");
    const auto [low, high] =
        std::ranges::minmax(lit, {}, [](glm::dvec3 point) { return azimuthOf(point); });
    if (azimuthOf(high) - azimuthOf(low) > kWidestDegrees * kRadiansPerDegree<double>)
        refuse(source,
               channel.place,
               "projector \"" + channel.name + "\" lights more than " + oneDecimal(kWidestDegrees) +
                   " degrees of the screen: give it a longer focal_x_px, or share with another");
}

// Sample `index` of `count` from edge to edge of what has to be lit.
double sample(int index, int count) {
    return kDarkBorder + (1 - 2 * kDarkBorder) * index / (count - 1);
}

// The dark points of one column of the screen, from top to bottom.
std::vector<glm::dvec3> darkPoints(const config::Screen& screen,
                                   const std::vector<Pinhole>& projectors,
                                   int column) {
    std::vector<glm::dvec3> dark;
    for (int row = 0; row < kRows; ++row) {
        const glm::dvec3 point =
            screenPointAt(screen, {sample(column, kColumns), sample(row, kRows)});
        const bool lit = std::ranges::any_of(projectors, [&](const Pinhole& projector) {
            return lightsInside(projector, point) && projector.pixelOf(point);
        });
        if (!lit) dark.push_back(point);
    }
    return dark;
}

// Names the first stretch of neighbouring columns that hold a dark point.
void checkCovered(const config::Rig& rig, const std::string& source) {
    std::vector<Pinhole> projectors;
    for (const config::Channel& channel : rig.channels) projectors.emplace_back(channel);
    std::vector<glm::dvec3> hole;
    bool reachesEdge = false;
    for (int column = 0; column < kColumns; ++column) {
        const auto dark = darkPoints(rig.screen, projectors, column);
        if (dark.empty() && !hole.empty()) break;
        if (dark.empty()) continue;
        hole.insert(hole.end(), dark.begin(), dark.end());
        reachesEdge = reachesEdge || column == 0 || column == kColumns - 1;
    }
    if (hole.empty()) return;
    const auto [low, high] =
        std::ranges::minmax(hole, {}, [](glm::dvec3 point) { return point.y; });
    const bool fullHeight = low.y < 0 && high.y > 0;
    const std::string where = "from " + sideways(azimuthOf(hole.front())) + " to " +
                              sideways(azimuthOf(hole.back())) + " of the middle, " +
                              oneDecimal(low.y) + " to " + oneDecimal(high.y) +
                              " m above the sweet spot";
    if (fullHeight && !reachesEdge)
        refuse(source,
               rig.screen.place,
               "neighbours leave a gap " + where +
                   ": turn them together, or shorten their focal_x_px");
    refuse(source,
           rig.screen.place,
           "no projector lights the screen " + where +
               ": aim one there, shorten its focal length, or make the screen smaller");
}

// The eyes must be before the screen, not beside or behind a part of it.
void checkEyes(const config::Rig& rig, const std::string& source) {
    for (std::size_t channel = 0; channel < rig.channels.size(); ++channel)
        for (const EyeSide eye : {EyeSide::Left, EyeSide::Right}) try {
                (void)channelFrustum(rig, channel, 0, eye);
            } catch (const Error& error) {
                refuse(source, rig.sweetSpotPlace, error.what());
            }
}

}  // namespace

void checkGeometry(const config::Rig& rig, const std::string& source) {
    for (const config::Channel& channel : rig.channels) checkProjector(rig, channel, source);
    checkCovered(rig, source);
    checkEyes(rig, source);
}

}  // namespace aquarama::wall
