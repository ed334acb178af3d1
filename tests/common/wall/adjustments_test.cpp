// SPDX-License-Identifier: Apache-2.0
// What is set by hand on top of projectors and wall files: control points, masks, limits of blends.
#include <cmath>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "common/formats/mpcdi.h"
#include "rigs.h"

namespace aquarama::wall {
namespace {

using testing::HasSubstr;

std::shared_ptr<const std::vector<std::byte>> bytesOf(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return std::make_shared<const std::vector<std::byte>>(bytes.begin(), bytes.end());
}

// The desk with overlaps four times as wide.
config::Rig wideDesk() {
    config::Rig rig = shippedRig("desk");
    for (config::Channel& channel : rig.channels) channel.projector.focalPixels *= 0.8;
    return rig;
}

config::Rig byHand(config::Rig rig, const std::string& text) {
    rig.adjustments = "by_hand.txtpb";
    rig.files["by_hand.txtpb"] = bytesOf(text);
    return rig;
}

std::string refusalOf(const config::Rig& rig) {
    try {
        const Wall wall(rig);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

std::string placeText(const std::string& field, glm::dvec2 place) {
    return field + " { x_px: " + std::to_string(place.x) + " y_px: " + std::to_string(place.y) +
           " } ";
}

// The rig as a calibration says it, with its own blend or not: every place is shown a little to the
// right.
config::Rig calibrated(config::Rig rig, bool hasBlend) {
    const Wall wall(rig);
    formats::WallFile file;
    file.profile = formats::Profile::Content;
    for (std::size_t i = 0; i < rig.channels.size(); ++i) {
        formats::FileChannel& channel = file.channels.emplace_back();
        channel.name = rig.channels[i].name;
        channel.sizePixels = rig.channels[i].sizePixels;
        formats::Warp warp{.size = channel.sizePixels, .samples = {}};
        formats::Mask blend{.size = channel.sizePixels, .bits = 16, .gamma = 1, .codes = {}};
        for (const glm::vec4& pixel : wall.warp(i).pointAndWeight) {
            const glm::dvec2 place = wall.screen().unrolled(glm::dvec3(pixel));
            warp.samples.emplace_back(pixel.w > 0 ? glm::vec3(place + glm::dvec2(0.004, 0), 0)
                                                  : glm::vec3(NAN));
            blend.codes.push_back(static_cast<std::uint16_t>(std::lround(65535 * pixel.w)));
        }
        channel.warp = std::move(warp);
        if (hasBlend) channel.blend = std::move(blend);
        rig.channels[i].wallFile = {"hall.mpcdi", channel.name, ""};
    }
    rig.files["hall.mpcdi"] =
        std::make_shared<const std::vector<std::byte>>(formats::encodeMpcdi(file, 2));
    return rig;
}

glm::dvec2 panoramaOf(const Wall& wall, const config::Rig& rig, glm::dvec3 point) {
    return wall.screen().unrolled(point) * glm::dvec2(rig.panoramaPixels);
}

double sumAt(const Wall& wall, glm::dvec3 point) {
    double sum = 0;
    for (std::size_t c = 0; c < wall.channels(); ++c) sum += wall.weight(c, point);
    return sum;
}

TEST(Adjustments, ofAnEmptyFileChangeNoBit) {
    for (const bool isCalibrated : {false, true}) {
        const config::Rig rig =
            isCalibrated ? calibrated(shippedRig("desk"), true) : shippedRig("desk");
        const Wall before(rig), after(byHand(rig, "# nothing yet\n"));
        for (std::size_t c = 0; c < rig.channels.size(); ++c) {
            const WarpMap a = before.warp(c), b = after.warp(c);
            EXPECT_EQ(a.pointAndWeight, b.pointAndWeight);
            EXPECT_EQ(a.blend, b.blend);
        }
    }
}

// A rig, projected and calibrated, with three points of the middle channel, two of them near each
// other.
class ControlPoints : public testing::TestWithParam<bool> {
  protected:
    static constexpr double kRadius = 90;
    ControlPoints()
        : rig(GetParam() ? calibrated(shippedRig("desk"), false) : shippedRig("desk")),
          before(rig) {
        size = glm::dvec2(rig.panoramaPixels);
        places = {size * glm::dvec2(0.5, 0.4), size * glm::dvec2(0.5, 0.4) + glm::dvec2(50, 10)};
        picture = panoramaOf(before, rig, before.channel(1).pointOf(kPixel, 0).value());
        places.push_back(picture);
        std::string text;
        for (std::size_t i = 0; i < places.size(); ++i)
            text += "points { channel: \"middle\" " +
                    (i == 2 ? placeText("picture", kPixel) : placeText("panorama", places[i])) +
                    "right_px: " + std::to_string(moves[i].x) +
                    " down_px: " + std::to_string(moves[i].y) +
                    " radius_px: " + std::to_string(kRadius) + " }\n";
        adjusted = byHand(rig, text);
    }
    glm::dvec3 at(const Wall& wall, glm::dvec2 place) const {
        return wall.screen().at(place / size).value();
    }
    // How far the nearest point is.
    double distance(glm::dvec2 place) const {
        double least = 1e9;
        for (const glm::dvec2& point : places) least = std::min(least, glm::distance(place, point));
        return least;
    }

    const glm::dvec2 kPixel{100, 60};
    config::Rig rig, adjusted;
    Wall before;
    glm::dvec2 size{}, picture{};
    std::vector<glm::dvec2> places;
    const std::vector<glm::dvec2> moves{{7, -3}, {4, 5}, {-6, 2.5}};
};
INSTANTIATE_TEST_SUITE_P(ProjectedAndCalibrated, ControlPoints, testing::Bool());

// What is to be seen at a place is thrown by the pixel that lit the place so far away.
TEST_P(ControlPoints, moveExactlyWhatTheySay) {
    const Wall after(adjusted);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const auto was = before.channel(1).pixelOf(at(before, places[i] + moves[i]));
        const auto is = after.channel(1).pixelOf(at(after, places[i]));
        ASSERT_TRUE(was && is);
        EXPECT_LT(glm::distance(*was, *is), 1e-6) << i;
        const auto shown = after.channel(1).pointOf(*was, 0);
        ASSERT_TRUE(shown);
        EXPECT_LT(glm::distance(panoramaOf(after, rig, *shown), places[i]), 0.01) << i;
    }
}

TEST_P(ControlPoints, moveNothingBeyondTheirRadius) {
    const Wall after(adjusted);
    Dice dice;
    int near = 0, far = 0;
    for (int i = 0; i < 4000; ++i) {
        const glm::dvec2 pixel(dice.between(0, rig.channels[1].sizePixels.x),
                               dice.between(0, rig.channels[1].sizePixels.y));
        const auto was = before.channel(1).pointOf(pixel, kSpillMetres);
        const auto is = after.channel(1).pointOf(pixel, kSpillMetres);
        ASSERT_EQ(was.has_value(), is.has_value());
        if (!was) continue;
        const bool isFar = distance(panoramaOf(before, rig, *was)) >= kRadius;
        ++(isFar ? far : near);
        if (isFar) {
            ASSERT_EQ(*was, *is);
        }
        const glm::dvec2 moved = panoramaOf(after, rig, *is) - panoramaOf(before, rig, *was);
        ASSERT_LT(glm::length(moved), 10);
    }
    EXPECT_GT(near, 100);
    EXPECT_GT(far, 100);
    EXPECT_EQ(before.warp(0).pointAndWeight.size(), after.warp(0).pointAndWeight.size());
    EXPECT_EQ(before.channel(0).pointOf({30, 30}, 0), after.channel(0).pointOf({30, 30}, 0));
}

TEST_P(ControlPoints, leadPointsBackToTheirPixels) {
    const Wall after(adjusted);
    Dice dice;
    for (int i = 0; i < 500; ++i) {
        const glm::dvec2 place =
            places[0] + glm::dvec2(dice.between(-95, 95), dice.between(-60, 60));
        const auto pixel = after.channel(1).pixelOf(at(after, place));
        ASSERT_TRUE(pixel);
        const auto shown = after.channel(1).pointOf(*pixel, 0);
        ASSERT_TRUE(shown);
        EXPECT_LT(glm::distance(panoramaOf(after, rig, *shown), place), 0.02);
    }
}

TEST(ControlPointsThatFold, areNamed) {
    const config::Rig rig = shippedRig("desk");
    const glm::dvec2 middle = glm::dvec2(rig.panoramaPixels) / 2.0;
    const std::string one = "points { channel: \"middle\" " + placeText("panorama", middle);
    EXPECT_THAT(refusalOf(byHand(rig, "\n" + one + "right_px: 30 radius_px: 60 }")),
                testing::AllOf(HasSubstr("by_hand.txtpb:2:1"), HasSubstr("folds the picture: ")));
    EXPECT_EQ(refusalOf(byHand(rig, one + "right_px: 20 radius_px: 60 }")), "");
    // Each alone is well, but they move towards each other.
    const std::string left = one + "right_px: 12 radius_px: 60 }\n";
    const std::string right = "points { channel: \"middle\" " +
                              placeText("panorama", middle + glm::dvec2(25, 0)) +
                              "right_px: -12 radius_px: 60 }\n";
    EXPECT_EQ(refusalOf(byHand(rig, left)), "");
    EXPECT_EQ(refusalOf(byHand(rig, right)), "");
    EXPECT_THAT(refusalOf(byHand(rig, left + right)),
                testing::AllOf(HasSubstr("by_hand.txtpb:1:1"),
                               HasSubstr("together with the points at line 2")));
    EXPECT_THAT(refusalOf(byHand(rig, one + "right_px: 1 }" + one + "right_px: 2 }")),
                HasSubstr("lie at one place"));
    EXPECT_THAT(
        refusalOf(byHand(rig, "points { channel: \"middle\" picture { x_px: -900 y_px: 0 } }")),
        HasSubstr("lights no screen"));
}

// A strip of the panorama about the middle of the overlap of the left and middle channels, with a
// corner that the left one alone lights.
const char* kMask =
    "masks { channel: \"left\" panorama { x_px: 260 y_px: 60 } panorama { x_px: 560 y_px: 70 } "
    "panorama { x_px: 540 y_px: 190 } panorama { x_px: 280 y_px: 200 } soft_px: 30 }\n";

class Masks : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(ProjectedAndWithABlend, Masks, testing::Bool());

TEST_P(Masks, handLightToNeighboursAsFarAsTheyReach) {
    const config::Rig rig = GetParam() ? calibrated(wideDesk(), true) : wideDesk();
    const Wall before(rig), after(byHand(rig, kMask));
    Dice dice;
    int dark = 0, handed = 0, soft = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::dvec2 place(dice.between(0.005, 0.995), dice.between(0.005, 0.995));
        const glm::dvec3 point = before.screen().at(place).value();
        const double sum = sumAt(before, point);
        if (!after.isMasked(point)) {
            ASSERT_NEAR(after.weight(0, point), before.weight(0, point), 1e-12);
            continue;
        }
        if (after.weight(0, point) == 0) ++dark;
        if (before.weight(1, point) > 0) {
            ++handed;
            ASSERT_NEAR(sumAt(after, point), sum, 1e-9);
        } else {
            ASSERT_LE(after.weight(0, point), before.weight(0, point));
            soft += after.weight(0, point) > 0;
        }
    }
    EXPECT_GT(dark, 200);
    EXPECT_GT(handed, 100);
    EXPECT_GT(soft, 50);
}

TEST(MasksInAPicture, areOfItsPixels) {
    const config::Rig rig = wideDesk();
    const WarpMap warp =
        Wall(byHand(rig,
                    "masks { channel: \"middle\" picture { x_px: 20 y_px: 10 } picture { x_px: 60 "
                    "y_px: 10 } picture { x_px: 60 y_px: 50 } picture { x_px: 20 y_px: 50 } "
                    "soft_px: 0 }"))
            .warp(1);
    const auto weightAt = [&](int x, int y) {
        return warp.pointAndWeight[static_cast<std::size_t>(y * warp.sizePixels.x + x)].w;
    };
    for (int y = 12; y < 50; ++y) {
        EXPECT_EQ(weightAt(20, y), 0) << y;
        EXPECT_EQ(weightAt(59, y), 0) << y;
        EXPECT_GT(weightAt(19, y), 0) << y;
        EXPECT_GT(weightAt(60, y), 0) << y;
    }
}

class BlendLimits : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(ProjectedAndWithABlend, BlendLimits, testing::Bool());

// Along the panorama: shares still sum to one, and both channels light no more than the limit.
TEST_P(BlendLimits, leaveTheRestToTheOneOrTheOther) {
    const config::Rig rig = GetParam() ? calibrated(wideDesk(), true) : wideDesk();
    const double width = 40;
    const Wall before(rig);
    const Wall after(byHand(rig, "blends { channel: \"left\" with: \"middle\" width_px: 40 }"));
    for (double v = 0.1; v < 0.95; v += 0.2) {
        double was = 0, is = 0, other = 0, steepest = 0, last = 1;
        const double step = 0.5;
        for (double x = 20; x < rig.panoramaPixels.x - 20; x += step) {
            const auto point = before.screen().at({x / rig.panoramaPixels.x, v}).value();
            ASSERT_NEAR(sumAt(after, point), sumAt(before, point), 1e-9);
            const auto areBoth = [&](const Wall& wall, std::size_t a, std::size_t b) {
                return wall.weight(a, point) > 1e-9 && wall.weight(b, point) > 1e-9;
            };
            was += areBoth(before, 0, 1) ? step : 0;
            is += areBoth(after, 0, 1) ? step : 0;
            other += areBoth(before, 1, 2) != areBoth(after, 1, 2) ? step : 0;
            steepest = std::max(steepest, std::abs(after.weight(0, point) - last));
            last = after.weight(0, point);
        }
        EXPECT_GT(was, 2 * width) << v;
        EXPECT_NEAR(is, width, 0.12 * width) << v;
        EXPECT_EQ(other, 0) << "the other overlap has no limit";
        EXPECT_LT(steepest, 4 * step / width) << "no edge";
    }
}

TEST(BlendLimitsThatAreWide, changeNothing) {
    const config::Rig rig = wideDesk();
    const Wall before(rig), after(byHand(rig, "blends { channel: \"middle\" width_px: 2000 }"));
    Dice dice;
    for (int i = 0; i < 5000; ++i) {
        const auto point =
            before.screen().at({dice.between(0.01, 0.99), dice.between(0.01, 0.99)}).value();
        ASSERT_NEAR(after.weight(1, point), before.weight(1, point), 1e-12);
    }
}

// Where the limit gives a place to a channel that is masked there, the other one lights it.
TEST(MasksAndLimits, togetherStillSumToOne) {
    const config::Rig rig = wideDesk();
    const Wall wall(
        byHand(rig, std::string(kMask) + "blends { channel: \"left\" width_px: 10 }\n"));
    Dice dice;
    for (int i = 0; i < 5000; ++i) {
        const auto point =
            wall.screen().at({dice.between(0.3, 0.7), dice.between(0.01, 0.99)}).value();
        ASSERT_NEAR(sumAt(wall, point), 1, 1e-9);
    }
}

}  // namespace
}  // namespace aquarama::wall
