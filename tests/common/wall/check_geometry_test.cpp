// SPDX-License-Identifier: Apache-2.0
// A rig whose projectors cannot show one wall is refused where it was written.
#include <cmath>
#include <cstdio>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "common/base/units.h"
#include "rigs.h"

namespace aquarama::wall {
namespace {

std::string refusal(const config::Rig& rig) {
    try {
        checkGeometry(rig, "hall.txtpb");
    } catch (const Error& error) {
        return error.what();
    }
    return "accepted";
}

std::string at(config::SourcePlace place) {
    return "hall.txtpb:" + std::to_string(place.line) + ":" + std::to_string(place.column) + ": ";
}

TEST(CheckGeometry, acceptsTheRigsThatComeWithAquarama) {
    for (const char* name : {"theatre", "touring", "desk"})
        EXPECT_EQ(refusal(shippedRig(name)), "accepted") << name;
}

TEST(CheckGeometry, aProjectorThatLooksAwayIsNamedAtItsChannel) {
    config::Rig rig = shippedRig("desk");
    rig.channels[2].projector.yawPitchRollRadians.x = 140.8 * kRadiansPerDegree<double>;
    EXPECT_THAT(refusal(rig),
                testing::StartsWith(at(rig.channels[2].place) +
                                    "projector \"right\" misses the screen: aim it"));
}

// As somebody gives them who takes z for the way from the audience.
TEST(CheckGeometry, aCornerOfHandsBehindTheViewerIsNamed) {
    config::Rig rig = shippedRig("desk");
    rig.touch.emplace();
    rig.touch->topLeft = {-1, 0.5, -1};
    rig.touch->topRight = {1, 0.5, -1};
    rig.touch->bottomLeft = {-1, -0.5, -1};
    EXPECT_EQ(refusal(rig), "accepted");
    rig.places.touch = {70, 3};
    rig.touch->topRight.z = 1.5;
    EXPECT_THAT(refusal(rig),
                testing::StartsWith(at({70, 3}) + "top_right of touch lies behind the viewer"));
    rig.touch->peopleReachMetres = 2;
    EXPECT_EQ(refusal(rig), "accepted") << "people may stand behind the viewer";
}

TEST(CheckGeometry, aGapBetweenNeighboursIsNamedInDegrees) {
    config::Rig rig = shippedRig("desk");
    rig.channels[1].projector.focalPixels.x *= 1.4;  // 30 degrees wide instead of 42
    const std::string said = refusal(rig);
    EXPECT_THAT(said, testing::StartsWith(at(rig.screen.place) + "neighbours leave a gap from "));
    double from = 0;
    double to = 0;
    const std::string degrees = said.substr(said.find(" from "));
    ASSERT_EQ(
        std::sscanf(degrees.c_str(), " from %lf degrees left to %lf degrees left", &from, &to), 2);
    // The left one's light ends where its last column falls, the middle one's where its first does.
    const auto azimuth = [&](std::size_t channel, double x) {
        const double middleRow = rig.channels[channel].sizePixels.y / 2.0;
        const auto point = Wall(rig).channel(channel).pointOf({x, middleRow}, 0);
        return std::atan2(-point->x, -point->z) / kRadiansPerDegree<double>;
    };
    EXPECT_NEAR(from, azimuth(0, rig.channels[0].sizePixels.x), 0.8);
    EXPECT_NEAR(to, azimuth(1, 0), 0.8);  // the borders lean by as much
}

TEST(CheckGeometry, aScreenThatReachesPastTheLightIsNamedInDegrees) {
    config::Rig rig = shippedRig("theatre");
    rig.screen.arcRadians = 140 * kRadiansPerDegree<double>;
    EXPECT_THAT(refusal(rig),
                testing::StartsWith(at(rig.screen.place) +
                                    "no projector lights the screen from 69.3 degrees left"));
}

TEST(CheckGeometry, aScreenThatIsTallerThanTheLightIsRefused) {
    config::Rig rig = shippedRig("theatre");
    rig.screen.heightMetres *= 1.1;
    EXPECT_THAT(refusal(rig), testing::HasSubstr("no projector lights the screen"));
}

TEST(CheckGeometry, aProjectorForMoreThanAFlatPictureHoldsIsRefused) {
    config::Rig rig = axisRig();
    rig.screen.arcRadians = 170 * kRadiansPerDegree<double>;
    rig.screen.heightMetres = 0.01;
    rig.channels[0].projector.focalPixels = {2, 2};
    EXPECT_THAT(refusal(rig), testing::HasSubstr("150.0 degrees"));
}

}  // namespace
}  // namespace aquarama::wall
