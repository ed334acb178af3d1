// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "common/wall/wall.h"
#include "render_node/show/controls.h"
#include "render_node/show/window_fit.h"
#include "tests/common/wall/rigs.h"

namespace aquarama::show {
namespace {

constexpr std::size_t kMiddleChannel = 1;  // channel of the desk
const wire::Eye kEye{.positionMetres = {1, -6, 2}, .worldFromWall = {1, 0, 0, 0}};

// By closed forms alone: the screen is seen from its middle.
TEST(Pointing, theMiddleOfTheMiddleChannelLooksStraightAhead) {
    const Pointing pointing(wall::shippedRig("desk"), kMiddleChannel);
    const auto direction = pointing.directionOf(pointing.middle(), kEye);
    ASSERT_TRUE(direction);
    EXPECT_NEAR(direction->x, 0, 1e-3);
    EXPECT_LT(direction->z, -0.95F);
    EXPECT_NEAR(glm::length(*direction), 1, 1e-5);
}

// What a pixel lights and what is dropped there lie on one ray from the eye.
TEST(Pointing, aPinchFallsBehindThePixelThatIsPointedAt) {
    const config::Rig rig = wall::shippedRig("theatre");
    for (std::size_t channel = 0; channel < rig.channels.size(); ++channel) {
        const Pointing pointing(rig, channel);
        for (const glm::dvec2 share : {glm::dvec2(0.5, 0.5), {0.2, 0.7}, {0.8, 0.3}}) {
            const glm::dvec2 pixel = share * glm::dvec2(rig.channels[channel].sizePixels);
            const auto lit = wall::Wall(rig).channel(channel).pointOf(pixel, 0);
            ASSERT_TRUE(lit);
            const auto pinch = pointing.pinchAt(glm::vec2(pixel), kEye);
            ASSERT_TRUE(pinch);
            const glm::vec3 way = *pinch - kEye.positionMetres;
            EXPECT_NEAR(glm::length(way), 2.5F, 1e-3F);
            EXPECT_GT(glm::dot(glm::normalize(way), glm::vec3(glm::normalize(*lit))), 0.99999F);
        }
    }
}

TEST(Pointing, turnsWithTheSubmarine) {
    const Pointing pointing(wall::shippedRig("desk"), kMiddleChannel);
    const wire::Eye left{
        .positionMetres = {0, -6, 0},
        .worldFromWall = glm::angleAxis(glm::half_pi<float>(), glm::vec3(0, 1, 0))};
    const auto direction = pointing.directionOf(pointing.middle(), left);
    ASSERT_TRUE(direction);
    EXPECT_LT(direction->x, -0.95F);
}

TEST(Pointing, dropsNothingIntoTheAir) {
    const Pointing pointing(wall::shippedRig("desk"), kMiddleChannel);
    const wire::Eye shallow{.positionMetres = {0, -0.1F, 0}, .worldFromWall = {1, 0, 0, 0}};
    const auto pinch = pointing.pinchAt({240, 60}, shallow);
    ASSERT_TRUE(pinch);
    EXPECT_GT(pointing.directionOf({240, 60}, shallow)->y, 0.1F);
    EXPECT_LT(pinch->y, 0);
}

TEST(WindowFit, aWindowOfThePicturesSizeIsThePicture) {
    EXPECT_EQ(picturePlace({480, 360}, {480, 360}, {12.5F, 34.5F}), glm::vec2(12.5F, 34.5F));
    EXPECT_EQ(picturePlace({480, 360}, {480, 360}, {480, 10}), std::nullopt);
    EXPECT_EQ(picturePlace({480, 360}, {480, 360}, {-1, 10}), std::nullopt);
}

// 480 x 360 in 1000 x 600: 800 x 600, with 100 dark pixels to each side.
TEST(WindowFit, aWiderWindowHasThePictureInItsMiddle) {
    EXPECT_EQ(picturePlace({1000, 600}, {480, 360}, {500, 300}), glm::vec2(240, 180));
    EXPECT_EQ(picturePlace({1000, 600}, {480, 360}, {100, 0}), glm::vec2(0, 0));
    EXPECT_EQ(picturePlace({1000, 600}, {480, 360}, {99, 300}), std::nullopt);
    EXPECT_EQ(picturePlace({1000, 600}, {480, 360}, {900.5F, 300}), std::nullopt);
}

TEST(WindowFit, aPlaceThatIsNoNumberIsNowhere) {
    EXPECT_EQ(picturePlace({480, 360}, {480, 360}, {std::nanf(""), 1}), std::nullopt);
}

// An odd rest: the picture's lowest row is where the lower left corner says.
TEST(WindowFit, rowsAreCountedFromTheTopAsTheWindowsAre) {
    const WindowFit fit = fitInto({480, 365}, {480, 360});
    EXPECT_EQ(fit.size, glm::ivec2(480, 360));
    EXPECT_EQ(fit.corner.y, 2);
    EXPECT_EQ(picturePlace({480, 365}, {480, 360}, {0, 3}), glm::vec2(0, 0));
    EXPECT_EQ(picturePlace({480, 365}, {480, 360}, {0, 2.5F}), std::nullopt);
}

}  // namespace
}  // namespace aquarama::show
