// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/node_card.h"

#include <algorithm>
#include <bit>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "common/base/dot_font.h"

namespace aquarama::show {
namespace {

const enrol::NodeSign kSign{"B", "K7M4-QD9X", {"192.168.7.3"}};

int dotsOf(const std::string& text) {
    int dots = 0;
    for (const char character : text) dots += std::popcount(glyphOf(character));
    return dots;
}

TEST(NodeCard, spellsLetterCodeAndAddress) {
    const auto dots = cardDots(kSign, {1400, 1050});
    const std::string all =
        "B" + std::string("CODE K7M4-QD9X") + "192.168.7.3" + "GIVE IT A CHANNEL IN THE CONSOLE";
    EXPECT_EQ(static_cast<int>(dots.size()), dotsOf(all));
    // The letter is the largest: half of the screen's height.
    const int largest = std::ranges::max_element(dots, {}, &CardDot::size)->size;
    EXPECT_EQ(largest, 75);
    EXPECT_EQ(std::ranges::count(dots, largest, &CardDot::size), dotsOf("B"));
    std::set<int> heights;  // of its dots, upright: seven rows
    for (const CardDot& dot : dots)
        if (dot.size == largest) heights.insert(dot.corner.y);
    EXPECT_EQ(heights.size(), 7U);
}

TEST(NodeCard, isWithinEveryScreenAndNoDotsOverlap) {
    for (const glm::ivec2 size : {glm::ivec2(1, 1),
                                  glm::ivec2(320, 200),
                                  glm::ivec2(480, 1920),
                                  glm::ivec2(3840, 2160),
                                  glm::ivec2(7680, 1080)}) {
        const auto dots = cardDots(kSign, size);
        for (const CardDot& dot : dots) {
            EXPECT_GE(dot.corner.x, 0);
            EXPECT_GE(dot.corner.y, 0);
            EXPECT_LE(dot.corner.x + dot.size, size.x);
            EXPECT_LE(dot.corner.y + dot.size, size.y);
        }
        for (std::size_t i = 0; i < dots.size(); ++i)
            for (std::size_t j = 0; j < i; ++j) {
                const glm::ivec2 apart = glm::abs(dots[i].corner - dots[j].corner);
                const int least = std::min(dots[i].size, dots[j].size);
                EXPECT_TRUE(apart.x >= least || apart.y >= least);
            }
    }
    EXPECT_TRUE(cardDots(kSign, {1, 1}).empty());
}

TEST(NodeCard, saysWhatIsMissing) {
    const auto dots = cardDots({"", "K7M4-QD9X", {}}, {1400, 1050});
    EXPECT_EQ(static_cast<int>(dots.size()),
              dotsOf(std::string("LOOKING FOR THE NETWORK") + "NO NETWORK" +
                     "GIVE IT A CHANNEL IN THE CONSOLE"));
}

}  // namespace
}  // namespace aquarama::show
