// SPDX-License-Identifier: Apache-2.0
// The sign for visitors: only one channel lights it, in the corner that the rig says, dot by dot.
#include "render_node/show/sign.h"

#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "render_node/gl/context.h"
#include "tests/common/wall/rigs.h"

namespace aquarama::show {
namespace {

using Corner = config::Guests::Corner;

ProjectionMap mapOf(const char* rig, std::size_t channel) {
    const wall::Wall wall(wall::shippedRig(rig));
    return projectionMap(wall.warp(channel), wall.frustum(channel, 0.01));
}

bool holds(const glm::vec4& place, const glm::vec4& pixel) {
    return pixel.x >= place.x && pixel.x <= place.z && pixel.y >= place.y && pixel.y <= place.w;
}

// Every projector's pixel that shows a part of it, on walls that are curved, flat, a dome, and of
// panels.
TEST(SignPlace, isWhereOneChannelAloneGivesFullLight) {
    for (const char* name : {"desk", "theatre", "flat_3", "dome_5", "televisions_3"})
        for (const Corner corner :
             {Corner::LowerLeft, Corner::LowerRight, Corner::UpperLeft, Corner::UpperRight}) {
            const ProjectionMap map = mapOf(name, 1);
            const auto place = signPlace(map, corner, 0.16, 0.8, scenePictureSize(map));
            ASSERT_TRUE(place) << name;
            int pixels = 0;
            for (const glm::vec4& pixel : map.placeAndWeight) {
                if (!holds(*place, pixel)) continue;
                ++pixels;
                ASSERT_GE(pixel.z, 0.999F) << name;
            }
            // 0.16 of the height, and 0.8 of that wide: of a picture that is lit in all of its
            // area.
            const double pictureHeight = scenePictureSize(map).y;
            EXPECT_GT(pixels, 0.5 * 0.8 * (0.16 * pictureHeight) * (0.16 * pictureHeight)) << name;
        }
}

TEST(SignPlace, isInItsCorner) {
    const ProjectionMap map = mapOf("desk", 1);
    const auto middleAt = [&](Corner corner) {
        const auto place = signPlace(map, corner, 0.2, 1, scenePictureSize(map));
        return place ? 0.5F * glm::vec2(place->x + place->z, place->y + place->w) : glm::vec2(-1);
    };
    for (const auto& [corner, x, y] : {std::tuple{Corner::LowerLeft, -1, -1},
                                       {Corner::LowerRight, 1, -1},
                                       {Corner::UpperLeft, -1, 1},
                                       {Corner::UpperRight, 1, 1}}) {
        const glm::vec2 off = middleAt(corner) - 0.5F;
        EXPECT_GT(off.x * static_cast<float>(x), 0.08F);
        EXPECT_GT(off.y * static_cast<float>(y), 0.2F);
    }
}

TEST(SignPlace, isNowhereWhereItIsLargerThanWhatOneChannelLights) {
    const ProjectionMap map = mapOf("desk", 1);
    EXPECT_FALSE(signPlace(map, Corner::LowerLeft, 0.5, 2.5, scenePictureSize(map)));
}

TEST(SignPass, drawsEachDot) {
    constexpr glm::ivec2 kSize{120, 80};
    const auto context = gl::makeOffscreenContext("auto", kSize);
    const gl::Target target(GL_RGBA32F, kSize);
    const SignPass pass;
    // 9 x 4 dots: a pattern without symmetry.
    const wire::Sign sign{.columns = 9, .rows = 4, .dots = std::string("\x8D\x21\xF0\x4C\x30", 5)};
    const glm::vec4 place(0.25F, 0.25F, 0.85F, 0.75F);  // 72 x 40 pixels, 8 x 10 a dot
    pass.draw(target.framebuffer(), kSize, sign, place);
    const std::vector<float> drawn = gl::readRgb<float>(target);  // top row first
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 9; ++column) {
            const int i = row * 9 + column;
            const bool isLit =
                (static_cast<unsigned char>(sign.dots[static_cast<std::size_t>(i / 8)]) >>
                     (7 - i % 8) &
                 1) != 0;
            const int x = 30 + 8 * column + 4;
            const int y = 20 + 10 * row + 5;
            const float light = drawn[static_cast<std::size_t>(y * kSize.x + x) * 3];
            EXPECT_EQ(light > 0.3F, isLit) << row << ' ' << column;
        }
    EXPECT_EQ(drawn[static_cast<std::size_t>(40 * kSize.x + 10) * 3], 0.0F) << "beside it";
}

}  // namespace
}  // namespace aquarama::show
