// SPDX-License-Identifier: Apache-2.0
// The hall shows the wall in perspective, and nothing in it shines but the screen.
#include <algorithm>

#include <gtest/gtest.h>

#include "calibration/compose/check.h"
#include "calibration/compose/compose.h"
#include "common/config/rig.h"

namespace aquarama::compose {
namespace {

constexpr glm::ivec2 kHallSize(320, 180);

config::Rig desk() {
    return config::readRig(AQUARAMA_SOURCE_DIR "/config/desk.txtpb");
}

TEST(Hall, aBlackWallLeavesTheHallBlack) {
    const config::Rig rig = desk();
    const Light hall = composeHall(rig, darkness(rig.panoramaPixels), kHallSize);
    EXPECT_TRUE(
        std::ranges::all_of(hall.rgb, [](glm::vec3 light) { return light == glm::vec3(0); }));
}

TEST(Hall, leftIsLeftAndTheWholeWallIsInView) {
    const config::Rig rig = desk();
    Light panorama = darkness(rig.panoramaPixels);
    for (int y = 0; y < panorama.sizePixels.y; ++y)
        for (int x = 0; x < panorama.sizePixels.x; ++x)
            panorama.at(x, y) =
                x < panorama.sizePixels.x / 2 ? glm::vec3(0.5F, 0, 0) : glm::vec3(0, 0.5F, 0);
    const Light hall = composeHall(rig, panorama, kHallSize);
    const auto isScreen = [&](int x, int y) {
        return std::max(hall.at(x, y).x, hall.at(x, y).y) == 0.5F;
    };
    const int row = kHallSize.y / 3;
    EXPECT_FALSE(isScreen(0, row));
    EXPECT_FALSE(isScreen(kHallSize.x - 1, row));
    EXPECT_FALSE(isScreen(kHallSize.x / 2, 0));
    EXPECT_FALSE(isScreen(kHallSize.x / 2, kHallSize.y - 1));
    EXPECT_EQ(hall.at(kHallSize.x / 4, row), glm::vec3(0.5F, 0, 0));
    EXPECT_EQ(hall.at(kHallSize.x * 3 / 4, row), glm::vec3(0, 0.5F, 0));
    int wide = 0;
    for (int x = 0; x < kHallSize.x; ++x) wide += isScreen(x, row) ? 1 : 0;
    EXPECT_GT(wide, kHallSize.x * 85 / 100);
}

TEST(Hall, theRoomGivesBackLessThanItGets) {
    const config::Rig rig = desk();
    Light panorama = darkness(rig.panoramaPixels);
    std::ranges::fill(panorama.rgb, glm::vec3(1));
    for (const glm::vec3& light : composeHall(rig, panorama, kHallSize).rgb)
        EXPECT_LE(light.x, 1.0001F);
}

TEST(Survey, theTheatreSharesAboutAHundredPixelsAndTheTouringRigASixth) {
    const config::Rig theatre = config::readRig(AQUARAMA_SOURCE_DIR "/config/theatre.txtpb");
    const ChannelSurvey left = surveyChannel(theatre, wall::Wall(theatre), 0);
    EXPECT_NEAR(left.leftDegrees, -60, 0.01);
    ASSERT_EQ(left.overlaps.size(), 1U);
    EXPECT_EQ(left.overlaps[0].with, "middle");
    EXPECT_NEAR(left.overlaps[0].pixels, 100, 15);

    const config::Rig touring = config::readRig(AQUARAMA_SOURCE_DIR "/config/touring.txtpb");
    const ChannelSurvey middle = surveyChannel(touring, wall::Wall(touring), 1);
    ASSERT_EQ(middle.overlaps.size(), 2U);
    for (const ChannelOverlap& overlap : middle.overlaps) {
        EXPECT_GT(overlap.pixels, 0.15 * 1920);
        EXPECT_LT(overlap.pixels, 0.20 * 1920);
    }
    EXPECT_NEAR(middle.pixelsPerDegree.x, middle.pixelsPerDegree.y, 2);  // square pixels
}

}  // namespace
}  // namespace aquarama::compose
