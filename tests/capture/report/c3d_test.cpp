// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "capture/report/take.h"
#include "tests/capture/report/c3d_reader.h"
#include "tests/support/scad.h"

namespace aquarama::report {
namespace {

TEST(C3d, givesBackEveryFloatOfTheTake) {
    for (int action = 0; action < motion::kCapturedActions; ++action) {
        const Take take =
            takeAtTicks(test::scadRepertoire(), static_cast<motion::Action>(action), 2);
        const test::C3dFile file(c3dOf(take));
        for (std::size_t f = 0; f < take.frames.size(); ++f) {
            for (std::size_t i = 0; i < body::kNodalPoints; ++i) {
                const glm::dvec3 node = take.frames[f].nodes.at(i);
                EXPECT_EQ(file.data(f, i, 0), static_cast<float>(node.x));
                EXPECT_EQ(file.data(f, i, 1), static_cast<float>(node.y));
                EXPECT_EQ(file.data(f, i, 2), static_cast<float>(node.z));
                EXPECT_EQ(file.data(f, i, 3), 0.0F) << "valid: a negative one is a lost marker";
            }
        }
    }
}

TEST(C3d, headerAndParametersAgree) {
    const Take take = takeAtTicks(test::scadRepertoire(), motion::Action::ForwardSlow, 4);
    const test::C3dFile file(c3dOf(take));
    EXPECT_EQ(file.size() % 512, 0U);
    EXPECT_EQ(file.at<std::uint16_t>(2), body::kNodalPoints);
    EXPECT_EQ(file.number<std::uint16_t>("POINT:USED"), body::kNodalPoints);
    EXPECT_EQ(file.at<std::uint16_t>(8), take.frames.size());
    EXPECT_EQ(file.number<std::uint16_t>("POINT:FRAMES"), take.frames.size());
    EXPECT_EQ(file.at<std::uint16_t>(16), file.number<std::uint16_t>("POINT:DATA_START"));
    EXPECT_LT(file.at<float>(12), 0) << "data are floats";
    EXPECT_EQ(file.at<float>(12), file.number<float>("POINT:SCALE"));
    EXPECT_EQ(file.at<float>(20), 60.0F);
    EXPECT_EQ(file.number<float>("POINT:RATE"), 60.0F);
    EXPECT_EQ(file.strings("POINT:UNITS"), std::vector<std::string>{"m"});
    EXPECT_EQ(file.strings("POINT:X_SCREEN"), std::vector<std::string>{"+X"});
    EXPECT_EQ(file.strings("POINT:Y_SCREEN"), std::vector<std::string>{"+Y"});
    EXPECT_EQ(file.strings("AQUARAMA:SEGMENT"), std::vector<std::string>{"forward_slow"});
    for (std::size_t i = 0; i < body::kNodalPoints; ++i) {
        EXPECT_EQ(file.strings("POINT:LABELS").at(i), markerLabel(i));
        EXPECT_EQ(file.strings("POINT:DESCRIPTIONS").at(i), markerDescription(i));
    }
}

}  // namespace
}  // namespace aquarama::report
