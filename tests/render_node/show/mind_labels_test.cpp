// SPDX-License-Identifier: Apache-2.0
#include <cctype>

#include <gtest/gtest.h>

#include "render_node/show/overlay.h"

namespace aquarama::show {
namespace {

constexpr glm::ivec2 kPicture{480, 360};

std::vector<Label> labelsAt(glm::vec2 place, const std::vector<std::string>& lines) {
    return mindLabels({place, 20}, {3, lines}, kPicture, 1);
}

TEST(MindLabels, bracketsStandAboutTheFish) {
    const auto labels = labelsAt({100, 50}, {});
    ASSERT_EQ(labels.size(), 2U);
    EXPECT_EQ(labels[0].text, "[");
    EXPECT_EQ(labels[1].text, "]");
    EXPECT_LT(labels[0].topLeft.x + extentInDots("[").x, 100 - 19);
    EXPECT_GT(labels[1].topLeft.x, 100 + 19);
}

TEST(MindLabels, theBoxIsOnTheSideWithMoreRoomAndInsideThePicture) {
    const std::vector<std::string> lines{"hunger 0.70", "eats pellet 12"};
    for (const float x : {0.0F, 100.0F, 200.0F, 280.0F, 400.0F, 479.0F})
        for (const float y : {0.0F, 180.0F, 359.0F}) {
            const auto labels = labelsAt({x, y}, lines);
            ASSERT_EQ(labels.size(), 4U);
            for (std::size_t i = 2; i < labels.size(); ++i) {
                const glm::vec2 end = labels[i].topLeft + extentInDots(labels[i].text);
                EXPECT_GE(labels[i].topLeft.x, 0);
                EXPECT_GE(labels[i].topLeft.y, 0);
                EXPECT_LE(end.x, kPicture.x);
                EXPECT_LE(end.y, kPicture.y);
                EXPECT_TRUE(x < 240 ? labels[i].topLeft.x > x : end.x < x) << x;
            }
        }
}

TEST(MindLabels, linesAreInCapitalsAndOfOneWidth) {
    const auto labels = labelsAt({100, 50}, {"long line", "short"});
    EXPECT_EQ(labels[2].text, "LONG LINE");
    EXPECT_EQ(labels[3].text, "SHORT    ");
}

TEST(MindLabels, longLinesGoOnBelowAtAWord) {
    const std::string line = "one two three four five six seven eight nine ten eleven twelve";
    const auto labels = labelsAt({100, 50}, {line});
    ASSERT_GT(labels.size(), 3U);
    std::string all;
    for (std::size_t i = 2; i < labels.size(); ++i) {
        EXPECT_LE(extentInDots(labels[i].text).x, 0.63F * static_cast<float>(kPicture.x));
        for (const char character : labels[i].text)
            if (character != ' ') all += static_cast<char>(std::tolower(character));
    }
    EXPECT_EQ(all, "onetwothreefourfivesixseveneightnineteneleventwelve");
}

// The master's text is bounded, but not for this picture.
TEST(MindLabels, whateverIsSaidStaysInsideThePicture) {
    const auto labels = mindLabels(
        {{5, 5}, 1e6F}, {3, std::vector<std::string>(48, std::string(120, 'x'))}, {200, 90}, 1);
    ASSERT_GT(labels.size(), 2U);
    EXPECT_LE(labels.back().topLeft.y + extentInDots("").y, 90);
}

}  // namespace
}  // namespace aquarama::show
