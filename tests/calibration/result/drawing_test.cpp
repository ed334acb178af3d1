// SPDX-License-Identifier: Apache-2.0
// Fields, curves and bytes as a page has them.
#include "calibration/result/drawing.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace aquarama::result {
namespace {

// The examples of RFC 4648.
TEST(Drawing, base64IsThatOfTheStandard) {
    for (const auto& [bytes, text] : {std::pair{"", ""},
                                      std::pair{"f", "Zg=="},
                                      std::pair{"fo", "Zm8="},
                                      std::pair{"foo", "Zm9v"},
                                      std::pair{"foobar", "Zm9vYmFy"}})
        EXPECT_EQ(base64(std::as_bytes(std::span(std::string_view(bytes)))), text);
}

TEST(Drawing, aFieldHasTheEndsOfItsScaleAndGreyWhereItHasNoValue) {
    Field field = emptyField({3, 1});
    field.at(0, 0) = -2;
    field.at(1, 0) = 4;
    EXPECT_EQ(largestOf(field), 4);
    const Picture picture = colouredField(field, kGrowing, -2, 4);
    for (std::size_t c = 0; c < 3; ++c) {
        const auto axis = static_cast<glm::length_t>(c);
        EXPECT_EQ(picture.rgb[c], std::lround(kGrowing.front()[axis] * 255));
        EXPECT_EQ(picture.rgb[3 + c], std::lround(kGrowing.back()[axis] * 255));
        EXPECT_NEAR(picture.rgb[6 + c], 145, 10);
    }
}

// As the luminance of viridis does: it can be printed in grey.
TEST(Drawing, theScaleOfAmountsGrowsBrighter) {
    double before = 0;
    for (int i = 0; i <= 100; ++i) {
        const glm::vec3 colour = colourAt(kGrowing, i / 100.0);
        const double light = 0.2126 * linearFromSrgb(double(colour.r)) +
                             0.7152 * linearFromSrgb(double(colour.g)) +
                             0.0722 * linearFromSrgb(double(colour.b));
        EXPECT_GT(light, before);
        before = light;
    }
}

TEST(Drawing, namesCannotEndAnElement) {
    EXPECT_EQ(escaped("<b a=\"1\" & 'x'>"), "&lt;b a=&quot;1&quot; &amp; &#39;x&#39;&gt;");
    const std::string text = plot({{"<left>", "red", {0, 1}}}, 1, 2, "a \"title\"");
    EXPECT_THAT(text, testing::HasSubstr("&lt;left&gt;"));
    EXPECT_THAT(text, testing::Not(testing::HasSubstr("<left>")));
}

// From the bottom to the top of the axis.
TEST(Drawing, aCurveRisesFromTheAxisToItsMost) {
    const std::string text = plot({{"one", "red", {0, 1, 2}}}, 2, 2, "curve");
    EXPECT_THAT(text, testing::HasSubstr("231.7,230.0 535.0,127.0 838.3,24.0"));
    EXPECT_THAT(text, testing::HasSubstr(">2</text>"));
}

}  // namespace
}  // namespace aquarama::result
