// SPDX-License-Identifier: Apache-2.0
// Two eyes before the screen: where each sees a point of the world on it, against closed forms.
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "common/wall/wall.h"
#include "rigs.h"

namespace aquarama::wall {
namespace {

config::Rig stereoRig() {
    config::Rig rig = shippedRig("theatre");
    rig.stereo.mode = config::StereoMode::SideBySide;
    return rig;
}

// Where the line from an eye to a point meets the screen.
glm::dvec3 onScreen(const config::Rig& rig, EyeSide side, glm::dvec3 point) {
    const glm::dvec3 eye = eyePosition(rig, side);
    return makeSurface(rig)->hit({eye, point - eye}, 1.0).value();
}

// At the height of the eyes, so far from the origin and so far to the right.
glm::dvec3 levelPoint(double distance, double azimuth) {
    return {distance * std::sin(azimuth), 0, -distance * std::cos(azimuth)};
}

TEST(Eyes, lieBesideTheSweetSpotByHalfTheirSeparation) {
    config::Rig rig = stereoRig();
    rig.stereo.eyeSeparationMetres = 0.06;
    rig.sweetSpotMetres = {0.5, -0.2, 0.3};
    EXPECT_EQ(eyePosition(rig, EyeSide::Between), rig.sweetSpotMetres);
    EXPECT_LT(glm::distance(eyePosition(rig, EyeSide::Left), {0.47, -0.2, 0.3}), 1e-15);
    EXPECT_LT(glm::distance(eyePosition(rig, EyeSide::Right), {0.53, -0.2, 0.3}), 1e-15);
}

// The eyes' separation, foreshortened towards the side, shrinks to nothing from the eyes to the
// point: at the screen 1 - r/D of it is left. Crossed (negative) before the screen. Terms of third
// order, (separation / distance)^2, are left out: a twentieth of a millimetre at arm's length.
TEST(Eyes, seeAPointAsFarApartOnTheScreenAsTheGeometrySays) {
    const config::Rig rig = stereoRig();
    const double radius = rig.screen.radiusMetres;
    const double separation = rig.stereo.eyeSeparationMetres;
    for (const double azimuth : {-0.9, -0.68, 0.0, 0.4, 0.68})
        for (const double distance : {1.0, 2.0, radius, 4.0, 12.0, 1e4}) {
            const glm::dvec3 point = levelPoint(distance, azimuth);
            const double apart = radius * (azimuthOf(onScreen(rig, EyeSide::Right, point)) -
                                           azimuthOf(onScreen(rig, EyeSide::Left, point)));
            const double closedForm = separation * std::cos(azimuth) * (1 - radius / distance);
            EXPECT_NEAR(apart, closedForm, 1e-3 * separation) << azimuth << ", " << distance;
        }
}

TEST(Eyes, lookTheSameWayThroughEveryChannel) {
    const config::Rig rig = stereoRig();
    for (std::size_t c = 0; c < rig.channels.size(); ++c) {
        const auto between = Wall(rig).frustum(c, 0.01);
        for (const EyeSide side : {EyeSide::Left, EyeSide::Right}) {
            const auto frustum = Wall(rig).frustum(c, 0.01, side);
            EXPECT_EQ(glm::dmat3(frustum.cameraFromWall), glm::dmat3(between.cameraFromWall));
            const glm::dvec4 seen = frustum.cameraFromWall * glm::dvec4(eyePosition(rig, side), 1);
            EXPECT_LT(glm::length(glm::dvec3(seen)), 1e-15) << "the camera is not at the eye";
        }
    }
}

TEST(Eyes, ofNoSeparationSeeAsOne) {
    config::Rig rig = stereoRig();
    rig.stereo.eyeSeparationMetres = 0;
    const auto left = Wall(rig).frustum(0, 0.01, EyeSide::Left);
    const auto between = Wall(shippedRig("theatre")).frustum(0, 0.01);
    EXPECT_EQ(left.cameraFromWall, between.cameraFromWall);
    EXPECT_EQ(left.left, between.left);
    EXPECT_EQ(left.top, between.top);
}

TEST(Eyes, holdAllThatTheChannelLightsWhereverTheyAre) {
    config::Rig rig = stereoRig();
    rig.sweetSpotMetres = {0.4, 0.3, 0.8};
    for (const EyeSide side : {EyeSide::Left, EyeSide::Right}) {
        const auto frustum = Wall(rig).frustum(2, 0, side);
        for (const glm::vec4& entry : Wall(rig).warp(2).pointAndWeight) {
            if (entry.w <= 0) continue;
            const glm::dvec4 seen = frustum.cameraFromWall * glm::dvec4(glm::dvec3(entry), 1);
            ASSERT_GT(seen.x / -seen.z, frustum.left - 1e-6);
            ASSERT_LT(seen.x / -seen.z, frustum.right + 1e-6);
            ASSERT_GT(seen.y / -seen.z, frustum.bottom - 1e-6);
            ASSERT_LT(seen.y / -seen.z, frustum.top + 1e-6);
        }
    }
}

TEST(Eyes, tooNearTheScreenAreRefused) {
    config::Rig rig = stereoRig();
    rig.sweetSpotMetres = {0, 0, -2.5};
    EXPECT_THROW(checkGeometry(rig, "rig.txtpb"), Error);
}

TEST(Eyes, aDisplayMayTakeThemOtherwiseThanTheRig) {
    config::Rig rig = stereoRig();
    rig.channels[1].display.stereo = config::StereoMode::Interlaced;
    rig.channels[1].display.swapEyes = true;
    EXPECT_EQ(stereoOf(rig, 0).mode, config::StereoMode::SideBySide);
    EXPECT_FALSE(stereoOf(rig, 0).swapEyes);
    EXPECT_EQ(stereoOf(rig, 1).mode, config::StereoMode::Interlaced);
    EXPECT_TRUE(stereoOf(rig, 1).swapEyes);
}

}  // namespace
}  // namespace aquarama::wall
