// SPDX-License-Identifier: Apache-2.0
#include "common/config/hall.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"

namespace aquarama::config {
namespace {

const std::vector<std::string> kChannels{"left", "right"};
const std::string kCamera =
    "camera { position { z_m: 1 } look_at { z_m: -3 } width_px: 640 height_px: 480 focal_px: 500 "
    "}\n";

std::string hallRefusalOf(const std::string& text) {
    try {
        static_cast<void>(parseHall(text, "hall.txtpb", kChannels));
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(Hall, aShortFileIsAHallAsItsRigSays) {
    const Hall hall = parseHall(kCamera, "hall.txtpb", kChannels);
    ASSERT_EQ(hall.projectors.size(), 2U);
    EXPECT_EQ(hall.projectors[1].focalFactor, 1);
    EXPECT_EQ(hall.projectors[1].brightness, 1);
    EXPECT_FALSE(hall.projectors[1].gamma.has_value());
    EXPECT_EQ(hall.screen.radiusFactor, 1);
    EXPECT_EQ(hall.screen.albedo, 1);
    EXPECT_EQ(hall.camera.principalPixels, glm::dvec2(320, 240));
    EXPECT_FALSE(hall.faults.latePicture.has_value());
    EXPECT_FALSE(hall.faults.moved.has_value());
}

TEST(Hall, everythingIsRead) {
    const Hall hall = parseHall(
        kCamera +
            "screen { radius_percent: 2 tilt_deg: 30 bump_m: 0.015 bump_seed: 7\n"
            "  dents { u: 0.25 v: 0.5 radius_m: 0.3 depth_m: 0.01 } bounces: true }\n"
            "projectors { channel: 'right' moved { x_m: 0.05 } roll_deg: 180 focal_percent: -2\n"
            "  lens { k3: 0.01 p2: 0.001 vignetting: 0.3 } gamma: 2.1 gamma: 2.2 gamma: 2.3\n"
            "  primaries: [1, 0.1, 0, 0, 0.9, 0, 0, 0, 1] keystone_y: 0.1 }\n"
            "faults { moved { channel: 'left' from_picture: 9 yaw_deg: 1 } swapped: 'right'\n"
            "  swapped: 'left' late_picture: 5 mode { channel: 'left' width_px: 800\n"
            "  height_px: 600 } }",
        "hall.txtpb",
        kChannels);
    EXPECT_DOUBLE_EQ(hall.screen.radiusFactor, 1.02);
    EXPECT_DOUBLE_EQ(hall.screen.tiltRadians, 0.52359877559829887);
    ASSERT_EQ(hall.screen.dents.size(), 1U);
    EXPECT_EQ(hall.screen.dents[0].place, glm::dvec2(0.25, 0.5));
    const HallProjector& right = hall.projectors[1];
    EXPECT_EQ(right.movedMetres.x, 0.05);
    EXPECT_DOUBLE_EQ(right.focalFactor, 0.98);
    EXPECT_EQ(right.lens.distortion.k3, 0.01);
    EXPECT_NEAR(right.gamma->z, 2.3, 1e-6);
    EXPECT_NEAR(right.primaries[1][0], 0.1, 1e-6);  // the first row's second
    EXPECT_EQ(hall.faults.moved->fromPicture, 9U);
    EXPECT_EQ((*hall.faults.swapped)[0], 1U);
    EXPECT_EQ(hall.faults.latePicture, 5U);
    EXPECT_EQ(hall.faults.mode->sizePixels, glm::ivec2(800, 600));
}

TEST(Hall, mistakesAreNamedAtTheirPlace) {
    EXPECT_THAT(hallRefusalOf("screen { bump_m: 0.01 }"), testing::HasSubstr("hall.txtpb:1:1"));
    EXPECT_THAT(hallRefusalOf(kCamera + "projectors { channel: 'top' }"),
                testing::AllOf(testing::HasSubstr("hall.txtpb:2:14"),
                               testing::HasSubstr("no channel \"top\"")));
    EXPECT_THAT(hallRefusalOf(kCamera + "projectors { channel: 'left' gamma: 2 }"),
                testing::HasSubstr("give 3 or none"));
    EXPECT_THAT(hallRefusalOf(kCamera + "projectors { channel: 'left' gamma: [2, 2, 7] }"),
                testing::HasSubstr("gamma has numbers from"));
    EXPECT_THAT(hallRefusalOf(kCamera + "faults { swapped: 'left' }"),
                testing::HasSubstr("name both"));
    EXPECT_THAT(hallRefusalOf(kCamera + "screen { bump_m: 3 }"),
                testing::HasSubstr("hall.txtpb:2:10"));
    EXPECT_THAT(hallRefusalOf("camera { position { z_m: 1 } look_at { z_m: 1 } width_px: 640 "
                              "height_px: 480 focal_px: 500 }"),
                testing::HasSubstr("looks at its own place"));
}

}  // namespace
}  // namespace aquarama::config
