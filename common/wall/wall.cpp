// SPDX-License-Identifier: Apache-2.0
#include "common/wall/wall.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <limits>

#include <glm/gtc/matrix_transform.hpp>
#include <glm/vec4.hpp>

#include "common/base/log.h"
#include "common/base/units.h"
#include "common/wall/pinhole.h"

namespace aquarama::wall {

glm::dvec3 eyePosition(const config::Rig& rig, EyeSide side) {
    const double half = rig.stereo.eyeSeparationMetres / 2;
    const double right = side == EyeSide::Between ? 0 : side == EyeSide::Left ? -half : half;
    return rig.sweetSpotMetres + glm::dvec3(right, 0, 0);
}

config::Stereo stereoOf(const config::Rig& rig, std::size_t channel) {
    assert(channel < rig.channels.size());
    const config::Display& display = rig.channels[channel].display;
    config::Stereo stereo = rig.stereo;
    stereo.mode = display.stereo.value_or(stereo.mode);
    stereo.swapEyes = display.swapEyes.value_or(stereo.swapEyes);
    return stereo;
}

std::optional<glm::dvec3> screenPoint(const config::Screen& screen,
                                      const config::Channel& channel,
                                      glm::dvec2 pixel) {
    return screenHit(screen, Pinhole(channel).ray(pixel), 0);
}

std::optional<glm::dvec2> projectorPixel(const config::Channel& channel,
                                         glm::dvec3 screenPointMetres) {
    return Pinhole(channel).pixelOf(screenPointMetres);
}

glm::dvec2 unrolled(const config::Screen& screen, glm::dvec3 point) {
    return {0.5 + azimuthOf(point) / screen.arcRadians, 0.5 - point.y / screen.heightMetres};
}

glm::dvec3 screenPointAt(const config::Screen& screen, glm::dvec2 position) {
    const double azimuth = (position.x - 0.5) * screen.arcRadians;
    return {screen.radiusMetres * std::sin(azimuth),
            (0.5 - position.y) * screen.heightMetres,
            -screen.radiusMetres * std::cos(azimuth)};
}

namespace {

// 0 with slope 0 at both borders of a picture, 1 in its middle. Two neighbours' bumps, divided by
// their sum, cross over in the overlap as t^2 / (t^2 + (1 - t)^2).
double bump(double position, double size) {
    const double t = position / size;
    const double hill = 4 * t * (1 - t);
    return hill * hill;
}

// The weight of a projector at a point before the weights are divided by their sum; 0 where it does
// not light the point.
double pull(const Pinhole& projector, glm::dvec3 point) {
    const auto pixel = projector.pixelOf(point);
    if (!pixel || !lightsInside(projector, point)) return 0;
    return bump(pixel->x, projector.size().x) * bump(pixel->y, projector.size().y);
}

}  // namespace

Blend::Blend(const config::Rig& rig) {
    for (const config::Channel& channel : rig.channels) projectors_.emplace_back(channel);
}

double Blend::weight(std::size_t channel, glm::dvec3 point) const {
    assert(channel < projectors_.size());
    const double own = pull(projectors_[channel], point);
    if (own <= 0) return 0;
    double sum = own;
    for (std::size_t i = 0; i < projectors_.size(); ++i)
        if (i != channel) sum += pull(projectors_[i], point);
    return own / sum;
}

double blendWeight(const config::Rig& rig, std::size_t channel, glm::dvec3 screenPointMetres) {
    return Blend(rig).weight(channel, screenPointMetres);
}

WarpMap warpMap(const config::Rig& rig, std::size_t channel) {
    assert(channel < rig.channels.size());
    const Blend blend(rig);
    const glm::ivec2 size = rig.channels[channel].sizePixels;
    WarpMap map;
    map.sizePixels = size;
    map.pointAndWeight.reserve(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x) {
            const Ray ray = blend.projector(channel).ray({x + 0.5, y + 0.5});
            const auto point = screenHit(rig.screen, ray, kSpillMetres);
            map.pointAndWeight.push_back(point ? glm::vec4(*point, blend.weight(channel, *point))
                                               : glm::vec4(0));
        }
    return map;
}

namespace {

// A camera at `eye` that looks horizontally towards an azimuth (right positive): upright things
// stay upright in every channel.
glm::dmat4 levelCamera(glm::dvec3 eye, double azimuth) {
    const glm::dvec3 right(std::cos(azimuth), 0, std::sin(azimuth));
    const glm::dvec3 back(-std::sin(azimuth), 0, std::cos(azimuth));
    const glm::dmat3 wallFromCamera(right, glm::dvec3(0, 1, 0), back);
    return glm::translate(glm::dmat4(glm::transpose(wallFromCamera)), -eye);
}

// The azimuth of the middle of what is lit, seen from between the eyes.
double azimuthOfMiddle(const std::vector<glm::dvec3>& lit, glm::dvec3 between) {
    const auto [leftmost, rightmost] =
        std::ranges::minmax(lit, {}, [&](glm::dvec3 point) { return azimuthOf(point - between); });
    return (azimuthOf(leftmost - between) + azimuthOf(rightmost - between)) / 2;
}

// The tangent of an angle that is larger by so much.
double widened(double tangent, double byRadians) {
    return std::tan(std::atan(tangent) + byRadians);
}

}  // namespace

ChannelFrustum channelFrustum(const config::Rig& rig,
                              std::size_t channel,
                              double marginRadians,
                              EyeSide eye) {
    assert(channel < rig.channels.size());
    // What is lit must be so far in front of the eye.
    constexpr double kLeastAheadMetres = 0.1;
    const std::vector<glm::dvec3> lit =
        litOutline(rig.screen, Pinhole(rig.channels[channel]), kSpillMetres);
    const double ahead = azimuthOfMiddle(lit, rig.sweetSpotMetres);
    ChannelFrustum frustum;
    frustum.cameraFromWall = levelCamera(eyePosition(rig, eye), ahead);
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    glm::dvec2 low(kInfinity);
    glm::dvec2 high(-kInfinity);
    for (const glm::dvec3& point : lit) {
        const glm::dvec4 seen = frustum.cameraFromWall * glm::dvec4(point, 1);
        if (-seen.z < kLeastAheadMetres)
            throw Error("channel \"" + rig.channels[channel].name +
                        "\" lights what is beside or behind the eyes; move sweet_spot back");
        const glm::dvec2 tangent = glm::dvec2(seen) / -seen.z;
        low = glm::min(low, tangent);
        high = glm::max(high, tangent);
    }
    frustum.left = widened(low.x, -marginRadians);
    frustum.bottom = widened(low.y, -marginRadians);
    frustum.right = widened(high.x, marginRadians);
    frustum.top = widened(high.y, marginRadians);
    return frustum;
}

glm::mat4 clipFromCamera(const ChannelFrustum& f, float nearMetres) {
    assert(f.right > f.left);
    assert(f.top > f.bottom);
    assert(nearMetres > 0);
    const double width = f.right - f.left;
    const double height = f.top - f.bottom;
    glm::mat4 clip(0.0F);
    clip[0][0] = static_cast<float>(2 / width);
    clip[1][1] = static_cast<float>(2 / height);
    clip[2][0] = static_cast<float>((f.right + f.left) / width);
    clip[2][1] = static_cast<float>((f.top + f.bottom) / height);
    clip[2][3] = -1;
    // So depth is near / distance.
    clip[3][2] = nearMetres;
    return clip;
}

// Angles between the directions of pixels next to each other, at a grid of places.
double finestPixelRadians(const config::Rig& rig) {
    // Places along each side of a picture.
    constexpr int kProbes = 5;
    double finest = std::numbers::pi;
    for (const config::Channel& channel : rig.channels) {
        const glm::dvec2 size(channel.sizePixels);
        for (int i = 0; i < kProbes * kProbes; ++i) {
            const glm::dvec2 pixel =
                size * (glm::dvec2(i % kProbes, i / kProbes) + 0.5) / double{kProbes};
            const auto here = screenPoint(rig.screen, channel, pixel);
            for (const glm::dvec2 step : {glm::dvec2(1, 0), glm::dvec2(0, 1)}) {
                const auto next = screenPoint(rig.screen, channel, pixel + step);
                if (!here || !next) continue;
                const double angle =
                    glm::length(glm::cross(glm::normalize(*here), glm::normalize(*next)));
                finest = std::min(finest, angle);
            }
        }
    }
    return finest;
}

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
    char text[32];
    std::snprintf(text, sizeof text, "%.1f", value);
    return text;
}

// As in "12.0 degrees left", "3.5 degrees right".
std::string sideways(double azimuth) {
    return oneDecimal(std::abs(azimuth) / kRadiansPerDegree<double>) + " degrees " +
           (azimuth < 0 ? "left" : "right");
}

// A projector must light some of the screen, and not too wide a part.
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

// Where sample `index` of `count` is between the edges of what has to be lit, as a share of the
// screen.
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

// All samples of the screen must be lit. Reports the first run of neighbouring columns that have a
// dark point.
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

// The eyes must be in front of the screen, not beside or behind a part of it.
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
