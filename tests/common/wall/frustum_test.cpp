// SPDX-License-Identifier: Apache-2.0
// A channel's frustum holds what the channel lights, and not much more.
#include <cmath>

#include <glm/vec4.hpp>
#include <gtest/gtest.h>

#include "rigs.h"

namespace aquarama::wall {
namespace {

constexpr double kMargin = 0.01;

class FrustumOfRig : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Shipped, FrustumOfRig, testing::Values("theatre", "touring", "desk"));

TEST_P(FrustumOfRig, holdsEveryLitPointAndTouchesTheOutermost) {
    const config::Rig rig = shippedRig(GetParam());
    const Wall wall(rig);
    for (std::size_t c = 0; c < rig.channels.size(); ++c) {
        const ChannelFrustum frustum = wall.frustum(c, 0);
        double left = 1e9, right = -1e9, bottom = 1e9, top = -1e9;
        for (const glm::vec4& entry : wall.warp(c).pointAndWeight) {
            if (entry.w <= 0) continue;
            const glm::dvec4 seen = frustum.cameraFromWall * glm::dvec4(glm::dvec3(entry), 1);
            ASSERT_LT(seen.z, 0);
            left = std::min(left, seen.x / -seen.z);
            right = std::max(right, seen.x / -seen.z);
            bottom = std::min(bottom, seen.y / -seen.z);
            top = std::max(top, seen.y / -seen.z);
        }
        // Pixel centres stay within the outline, by a pixel at most.
        const double pixel = 4.0 / rig.channels[c].sizePixels.y;
        for (const double slack : {left - frustum.left,
                                   frustum.right - right,
                                   bottom - frustum.bottom,
                                   frustum.top - top}) {
            EXPECT_GT(slack, -1e-6);
            EXPECT_LT(slack, pixel);
        }
    }
}

TEST_P(FrustumOfRig, growsByTheMarginAtEverySide) {
    const config::Rig rig = shippedRig(GetParam());
    const Wall wall(rig);
    const ChannelFrustum tight = wall.frustum(0, 0);
    const ChannelFrustum wide = wall.frustum(0, kMargin);
    EXPECT_NEAR(std::atan(tight.left) - std::atan(wide.left), kMargin, 1e-12);
    EXPECT_NEAR(std::atan(wide.right) - std::atan(tight.right), kMargin, 1e-12);
    EXPECT_NEAR(std::atan(tight.bottom) - std::atan(wide.bottom), kMargin, 1e-12);
    EXPECT_NEAR(std::atan(wide.top) - std::atan(tight.top), kMargin, 1e-12);
}

TEST(Frustum, ofAnAxisProjectorIsItsPicture) {
    config::Rig rig = axisRig();
    rig.channels[0].projector.focalPixels = {100, 100};  // all of the picture falls on the screen
    const ChannelFrustum frustum = Wall(rig).frustum(0, 0);
    EXPECT_NEAR(frustum.left, -0.5, 1e-9);
    EXPECT_NEAR(frustum.right, 0.5, 1e-9);
    EXPECT_NEAR(frustum.bottom, -0.5, 1e-9);
    EXPECT_NEAR(frustum.top, 0.5, 1e-9);
}

TEST(Frustum, clipCornersAndDepthAreReversedZeroToOne) {
    ChannelFrustum frustum;
    frustum.left = -0.3;
    frustum.right = 0.9;
    frustum.bottom = -0.2;
    frustum.top = 0.5;
    const glm::mat4 clip = clipFromCamera(frustum, 0.1F);
    const auto device = [&](glm::vec3 camera) {
        const glm::vec4 at = clip * glm::vec4(camera, 1);
        return glm::vec3(at) / at.w;
    };
    const glm::vec3 nearCorner = device(glm::vec3(-0.3F, -0.2F, -1) * 0.1F);
    EXPECT_NEAR(nearCorner.x, -1, 1e-6F);
    EXPECT_NEAR(nearCorner.y, -1, 1e-6F);
    EXPECT_NEAR(nearCorner.z, 1, 1e-6F);
    const glm::vec3 farCorner = device(glm::vec3(0.9F, 0.5F, -1) * 1e6F);
    EXPECT_NEAR(farCorner.x, 1, 1e-6F);
    EXPECT_NEAR(farCorner.y, 1, 1e-6F);
    EXPECT_NEAR(farCorner.z, 0, 1e-6F);
}

}  // namespace
}  // namespace aquarama::wall
