// SPDX-License-Identifier: Apache-2.0
// Skins that visitors have painted: which pictures are skins, and what their coarser levels show.
#include "common/body/side_skin.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "common/base/picture.h"
#include "common/body/side_view.h"

namespace aquarama::body {
namespace {

// Of codes that depend on the column alone.
template <class CodeOf>
PngPicture columns(int components, const CodeOf& codeOf) {
    PngPicture picture{.sizePixels = kSideTexels, .components = components, .bits = 8, .codes = {}};
    for (int y = 0; y < kSideTexels.y; ++y)
        for (int x = 0; x < kSideTexels.x; ++x)
            for (int c = 0; c < components; ++c)
                picture.codes.push_back(static_cast<std::uint16_t>(codeOf(x, c)));
    return picture;
}

SideSkin decoded(const PngPicture& picture) {
    return sideSkinOf(encodePng(picture, PngMeaning::Srgb), "a skin");
}

std::string objectionTo(const PngPicture& picture) {
    try {
        static_cast<void>(decoded(picture));
    } catch (const Error& problem) {
        return problem.what();
    }
    return "";
}

// Half of the light of white is code 188, not 128.
TEST(SideSkin, coarserLevelsShowTheMeanLightOfBlackAndWhite) {
    const SideSkin skin = decoded(columns(3, [](int x, int) { return x % 2 == 0 ? 0 : 255; }));
    const glm::u8vec4 grey{188, 188, 188, 255};
    for (std::size_t level = 1; level < kSideLevels; ++level) {
        const auto& texels = skin.levels.at(level);
        EXPECT_EQ(texels.size(),
                  static_cast<std::size_t>(sideTexelsAt(level).x * sideTexelsAt(level).y));
        EXPECT_TRUE(std::ranges::all_of(texels, [&](glm::u8vec4 one) { return one == grey; }))
            << level;
    }
    EXPECT_EQ(sideTexelsAt(kSideLevels - 1), glm::ivec2(1));
}

// What is outside of the outline is bled colour under an alpha of 0.
TEST(SideSkin, theFinestLevelIsThePictureWithoutItsAlpha) {
    const SideSkin skin = decoded(columns(4, [](int x, int c) { return c == 3 ? 0 : x % 256; }));
    for (int x = 0; x < kSideTexels.x; ++x) {
        const auto code = static_cast<std::uint8_t>(x % 256);
        EXPECT_EQ(skin.levels[0].at(static_cast<std::size_t>(x)),
                  glm::u8vec4(code, code, code, 255));
    }
}

TEST(SideSkin, whatIsNoSkinIsRefusedInOneLine) {
    PngPicture small = columns(3, [](int, int) { return 9; });
    small.sizePixels.y /= 2;
    small.codes.resize(small.codes.size() / 2);
    PngPicture deep = columns(3, [](int, int) { return 9; });
    deep.bits = 16;
    const PngPicture grey = columns(1, [](int, int) { return 9; });
    for (const PngPicture& picture : {small, deep, grey})
        EXPECT_THAT(objectionTo(picture),
                    testing::AllOf(testing::HasSubstr("a skin:"),
                                   testing::HasSubstr("1024 x 512"),
                                   testing::Not(testing::HasSubstr("\n"))));
    const std::vector<std::byte> noise(100, std::byte{7});
    EXPECT_THROW(static_cast<void>(sideSkinOf(noise, "noise")), Error);
}

}  // namespace
}  // namespace aquarama::body
