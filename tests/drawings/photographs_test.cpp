// SPDX-License-Identifier: Apache-2.0
// Simulated photographs of coloured sheets are found, with the colours and the outline that were
// drawn, and the confined decoder says the same. With AQUARAMA_SOAK in the environment 200 of up to
// 12 megapixels, else 20 smaller ones.
#include <cstdlib>

#include <gtest/gtest.h>

#include "common/wire/messages.h"
#include "tests/drawings/decoder.h"
#include "tests/drawings/judged.h"
#include "tests/drawings/snapshot.h"

namespace aquarama {
namespace {

TEST(Photographs, areReadAsDrawn) {
    drawings::Catalogue catalogue;
    ask::DrawingReader reader(test::decoderProgram(), test::kDecoderSeconds);
    std::size_t largest = 0;
    const auto decodesAlike = [&](const test::Judged& one) {
        const auto outcome = test::outcomeOf(reader, test::textOf(one.photo));
        ASSERT_EQ(test::wordOf(outcome), one.refused ? drawings::wordOf(*one.refused) : "")
            << one.species;
        if (one.refused) return;
        const auto& drawing = std::get<ask::ReadDrawing>(outcome);
        EXPECT_EQ(drawing.species, one.species);
        EXPECT_TRUE(drawing.skin == test::textOf(one.skin)) << one.species;
        largest = std::max(largest, drawing.skin.size());
    };
    const bool isSoak = std::getenv("AQUARAMA_SOAK") != nullptr;
    const int count = isSoak ? 200 : 20;
    const test::Judgement all = test::judgeAll(catalogue,
                                               {"clownfish",
                                                "blue_tang",
                                                "butterflyfish",
                                                "parrotfish",
                                                "moorish_idol",
                                                "blacktip_reef_shark"},
                                               count,
                                               isSoak ? 12 : 1.5,
                                               decodesAlike);
    EXPECT_GE(all.found, count * 97 / 100);
    EXPECT_LT(all.colourDifference, 8);
    EXPECT_LT(all.worstOutlineShare, 0.01);
    EXPECT_LE(largest, wire::kMostSkinBytes);
    std::cout << "the largest skin has " << largest << " bytes\n";
}

// The line that is printed along the outline is grey; a sheet that nobody has coloured is white.
TEST(Photographs, aFishThatNobodyColouredHasNoGreyRim) {
    drawings::Catalogue catalogue;
    const drawings::Sheet& sheet = catalogue.sheetOf("blue_tang");
    const test::Circumstances how{.sizePixels = {2000, 1500}, .unevenness = 0, .noise = 0};
    const test::Camera camera(how, drawings::kA4);
    const drawings::Drawing drawing =
        drawings::readDrawing(test::photographed(test::printed(sheet, drawings::kA4), how, camera),
                              [&](int number) { return catalogue.sheetOf(number); });
    const auto& codes = drawing.skin.codes;
    const auto width = static_cast<std::size_t>(drawing.skin.sizePixels.x);
    int rim = 0, grey = 0;
    for (std::size_t at = 4 * width; at + 4 * width < codes.size(); at += 4) {
        const bool isRim =
            codes[at + 3] > 0 && (codes[at - 1] == 0 || codes[at + 7] == 0 ||
                                  codes[at + 3 - 4 * width] == 0 || codes[at + 3 + 4 * width] == 0);
        rim += isRim ? 1 : 0;
        grey += isRim && codes[at + 1] < 225 ? 1 : 0;
    }
    EXPECT_GT(rim, 1000);
    EXPECT_LT(grey, rim / 20) << "but for thin ends, and lines of fins that come to the outline";
    std::cout << grey << " of " << rim << " texels of the rim are grey\n";
}

}  // namespace
}  // namespace aquarama
