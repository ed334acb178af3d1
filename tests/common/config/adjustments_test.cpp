// SPDX-License-Identifier: Apache-2.0
#include "common/config/adjustments.h"

#include <span>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"

namespace aquarama::config {
namespace {

using testing::AllOf;
using testing::HasSubstr;

Rig twoChannels() {
    Rig rig;
    rig.channels.resize(2);
    rig.channels[0].name = "left";
    rig.channels[1].name = "right";
    return rig;
}

std::string refusalOf(const std::string& text) {
    try {
        static_cast<void>(parseAdjustments(text, "by_hand.txtpb", twoChannels()));
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(AdjustmentsFile, everythingIsRead) {
    const Adjustments all = parseAdjustments(
        "points { channel: 'right' picture { x_px: 12 y_px: 34 } right_px: 1.5 down_px: -2 }\n"
        "masks { panorama { x_px: 1 y_px: 2 } panorama { x_px: 3 y_px: 4 } panorama { x_px: 5 "
        "y_px: 9 } soft_px: 0 }\n"
        "blends { channel: 'left' width_px: 80 }\n"
        "blends { channel: 'right' with: 'left' width_px: 60 }",
        "by_hand.txtpb",
        twoChannels());
    ASSERT_EQ(all.points.size(), 1U);
    EXPECT_EQ(all.points[0].channel, 1U);
    EXPECT_EQ(all.points[0].pixelsOf, PixelsOf::Picture);
    EXPECT_EQ(all.points[0].place, glm::dvec2(12, 34));
    EXPECT_EQ(all.points[0].byPixels, glm::dvec2(1.5, -2));
    EXPECT_EQ(all.points[0].radiusPixels, 400);
    ASSERT_EQ(all.masks.size(), 1U);
    EXPECT_FALSE(all.masks[0].channel);
    EXPECT_EQ(all.masks[0].pixelsOf, PixelsOf::Panorama);
    EXPECT_EQ(all.masks[0].corners[2], glm::dvec2(5, 9));
    EXPECT_EQ(all.masks[0].source.line, 2);
    ASSERT_EQ(all.blends.size(), 2U);
    EXPECT_FALSE(all.blends[0].with);
    EXPECT_EQ(all.blends[1].with, 0U);
    EXPECT_EQ(all.blends[1].widthPixels, 60);
}

TEST(AdjustmentsFile, mistakesAreNamedAtTheirPlace) {
    const std::string place = "panorama { x_px: 1 y_px: 1 } ";
    EXPECT_THAT(refusalOf("\npoints { channel: 'top' " + place + "}"),
                AllOf(HasSubstr("by_hand.txtpb:2:10"), HasSubstr("only left, right")));
    EXPECT_THAT(refusalOf("points { channel: 'left' }"), HasSubstr("needs one place"));
    EXPECT_THAT(refusalOf("points { " + place + "}"), HasSubstr("channel"));
    EXPECT_THAT(refusalOf("points { channel: 'left' " + place + "radius_px: 0 }"),
                HasSubstr("radius_px"));
    EXPECT_THAT(refusalOf("masks { " + place + place + "}"), HasSubstr("three corners"));
    EXPECT_THAT(refusalOf("masks { channel: 'left' }"), HasSubstr("corners of one kind"));
    EXPECT_THAT(refusalOf("masks { picture { x_px: 1 y_px: 1 } }"), HasSubstr("needs the channel"));
    EXPECT_THAT(refusalOf("blends { channel: 'left' with: 'left' width_px: 5 }"),
                AllOf(HasSubstr("by_hand.txtpb:1:26"), HasSubstr("another one")));
    EXPECT_THAT(refusalOf("blends { channel: 'left' }"), HasSubstr("width_px"));
    EXPECT_THAT(refusalOf("colours { }"), HasSubstr("by_hand.txtpb:1"));
}

TEST(AdjustmentsFile, losesOneEntryAndNothingElse) {
    const std::string first =
        "# the seam at the door\nblends { channel: 'left' width_px: 80 } # wide\n";
    const std::string second =
        "  points {\n  channel: \"right\"  # } is no end\n  panorama { x_px: 1 y_px: 2 }\n}";
    const std::string third = "\tmasks { picture < x_px: 1 y_px: 1 >";
    const auto placesOf = [](const std::string& text) {
        const Adjustments all = parseAdjustments(text, "by_hand.txtpb", twoChannels());
        return std::pair{all.points.at(0).source, all.blends.at(0).source};
    };
    const std::string text = first + second + "\n# end\n";
    EXPECT_EQ(withoutEntry(text, placesOf(text).first), first + "  \n# end\n");
    EXPECT_EQ(withoutEntry(text, placesOf(text).second),
              "# the seam at the door\n # wide\n" + second + "\n# end\n");
    EXPECT_EQ(withoutEntry(third, {1, 9}), "\t");
}

TEST(AdjustmentsFile, isNamedByARigOfProjectors) {
    Rig rig = twoChannels();
    EXPECT_TRUE(adjustmentsOf(rig).points.empty());
    rig.adjustments = "by_hand.txtpb";
    const std::string large(2U << 20U, '#');
    const auto bytes = std::as_bytes(std::span(large));
    rig.files["by_hand.txtpb"] =
        std::make_shared<const std::vector<std::byte>>(bytes.begin(), bytes.end());
    EXPECT_THROW(static_cast<void>(adjustmentsOf(rig)), Error);
}

}  // namespace
}  // namespace aquarama::config
