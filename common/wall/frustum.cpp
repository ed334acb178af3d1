// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/gtc/matrix_transform.hpp>

#include "common/units/error.h"
#include "common/wall/outline.h"
#include "common/wall/pinhole.h"
#include "common/wall/wall.h"

namespace aquarama::wall {

namespace {

// From `eye`, level, towards azimuth (right positive): upright things stay upright in every
// channel.
glm::dmat4 levelCamera(glm::dvec3 eye, double azimuth) {
    const glm::dvec3 right(std::cos(azimuth), 0, std::sin(azimuth));
    const glm::dvec3 back(-std::sin(azimuth), 0, std::cos(azimuth));
    const glm::dmat3 wallFromCamera(right, glm::dvec3(0, 1, 0), back);
    return glm::translate(glm::dmat4(glm::transpose(wallFromCamera)), -eye);
}

// The middle of what is lit, seen from between the eyes.
double azimuthOfMiddle(const std::vector<glm::dvec3>& lit, glm::dvec3 between) {
    const auto [leftmost, rightmost] =
        std::ranges::minmax(lit, {}, [&](glm::dvec3 point) { return azimuthOf(point - between); });
    return (azimuthOf(leftmost - between) + azimuthOf(rightmost - between)) / 2;
}

double widened(double tangent, double byRadians) {
    return std::tan(std::atan(tangent) + byRadians);
}

}  // namespace

ChannelFrustum channelFrustum(const config::Rig& rig,
                              std::size_t channel,
                              double marginRadians,
                              EyeSide eye) {
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
    const double width = f.right - f.left;
    const double height = f.top - f.bottom;
    glm::mat4 clip(0.0F);
    clip[0][0] = static_cast<float>(2 / width);
    clip[1][1] = static_cast<float>(2 / height);
    clip[2][0] = static_cast<float>((f.right + f.left) / width);
    clip[2][1] = static_cast<float>((f.top + f.bottom) / height);
    clip[2][3] = -1;
    clip[3][2] = nearMetres;  // depth = near / distance
    return clip;
}

double finestPixelRadians(const config::Rig& rig) {
    constexpr int kProbes = 5;  // along each side of a picture
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

}  // namespace aquarama::wall
