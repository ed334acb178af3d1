// SPDX-License-Identifier: Apache-2.0
// Through frustum and map to the projector's pixels: each eye is shown a point of the world where
// its line to the point meets the screen.
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "render_node/show/projection.h"
#include "tests/common/wall/rigs.h"

namespace aquarama::show {
namespace {

constexpr double kParallaxMargin = 0.01;

// Texture coordinate that the map has at a continuous pixel of the projector, between texels.
glm::dvec2 placeBetween(const ProjectionMap& map, glm::dvec2 pixel) {
    const glm::dvec2 at = pixel - 0.5;
    const glm::ivec2 low(glm::floor(at));
    const glm::dvec2 t = at - glm::dvec2(low);
    const auto texel = [&](int x, int y) {
        return glm::dvec2(map.placeAndWeight[static_cast<std::size_t>(y * map.sizePixels.x + x)]);
    };
    return glm::mix(glm::mix(texel(low.x, low.y), texel(low.x + 1, low.y), t.x),
                    glm::mix(texel(low.x, low.y + 1), texel(low.x + 1, low.y + 1), t.x),
                    t.y);
}

// Where a point of the world is in the picture of an eye's frustum.
glm::dvec2 seenAt(const wall::ChannelFrustum& frustum, glm::dvec3 point) {
    const glm::dvec4 seen = frustum.cameraFromWall * glm::dvec4(point, 1);
    const glm::dvec2 tangent = glm::dvec2(seen) / -seen.z;
    return {(tangent.x - frustum.left) / (frustum.right - frustum.left),
            (tangent.y - frustum.bottom) / (frustum.top - frustum.bottom)};
}

class Parallax : public testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(Channels, Parallax, testing::Values(0, 1, 2));

TEST_P(Parallax, ofEveryEyeEndsOnTheScreenWhereItsLineOfSightDoes) {
    config::Rig rig = wall::shippedRig("desk_stereo");
    rig.sweetSpotMetres = {0.1, -0.05, 0.2};
    const config::Channel& channel = rig.channels[GetParam()];
    const wall::Wall wall(rig);
    const wall::Optics& optics = wall.channel(GetParam());
    const glm::dvec3 middle = optics.pointOf(glm::dvec2(channel.sizePixels) / 2.0, 0).value();
    const wall::WarpMap warp = wall.warp(GetParam());
    for (const wall::EyeSide side : {wall::EyeSide::Left, wall::EyeSide::Right}) {
        const wall::ChannelFrustum frustum = wall.frustum(GetParam(), kParallaxMargin, side);
        const ProjectionMap map = projectionMap(warp, frustum);
        const glm::dvec3 eye = wall::eyePosition(rig, side);
        for (const double away : {0.4, 1.0, 2.5, 100.0}) {
            const glm::dvec3 point = middle * away;  // before, on and behind the screen
            const auto lit = wall.screen().hit({eye, point - eye}, 1).value();
            const auto pixel = optics.pixelOf(lit).value();
            const glm::dvec2 off = placeBetween(map, pixel) - seenAt(frustum, point);
            EXPECT_LT(glm::length(off * glm::dvec2(scenePictureSize(map))), 0.02)
                << "channel " << channel.name << ", " << away << " of the way to the screen";
        }
    }
}

}  // namespace
}  // namespace aquarama::show
