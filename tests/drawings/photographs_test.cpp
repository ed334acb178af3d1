// SPDX-License-Identifier: Apache-2.0
// Simulated photographs of coloured sheets are found, with the colours and the outline that were
// drawn. With AQUARAMA_SOAK in the environment 200 of up to 12 megapixels, else 20 smaller ones.
#include <cstdlib>

#include <gtest/gtest.h>

#include "tests/drawings/judged.h"

namespace aquarama {
namespace {

TEST(Photographs, areReadAsDrawn) {
    drawings::Catalogue catalogue;
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
                                               isSoak ? 12 : 1.5);
    EXPECT_GE(all.found, count * 97 / 100);
    EXPECT_LT(all.colourDifference, 8);
    EXPECT_LT(all.worstOutlineShare, 0.01);
}

}  // namespace
}  // namespace aquarama
