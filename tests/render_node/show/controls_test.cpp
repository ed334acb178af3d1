// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/controls.h"

#include <algorithm>
#include <cctype>
#include <string>

#include <gtest/gtest.h>

#include "render_node/context/context.h"
#include "render_node/show/font.h"
#include "tests/render_node/show/fake_session.h"

namespace aquarama {
namespace {

class ControlsTest : public testing::Test {
  protected:
    Events events_;
    FakeSession session_{events_, {}};
    Controls controls_{session_};
};

TEST_F(ControlsTest, quitGoesToTheWholeShow) {
    controls_.press('q');
    EXPECT_EQ(events_, Events{"send quit"});
}

TEST_F(ControlsTest, quitTwiceEndsThisNodeAlone) {
    controls_.press('q');
    controls_.press(kEscapeKey);
    EXPECT_EQ(events_[1], "stop");
}

TEST_F(ControlsTest, pauseGoesToTheWholeShow) {
    controls_.press('p');
    controls_.press(' ');
    EXPECT_EQ(events_, (Events{"send pause", "send pause"}));
}

TEST_F(ControlsTest, eachOverlayIsSwitchedByItsKeyAndBack) {
    const auto shown = [&] {
        const Overlays o = controls_.overlays();
        return std::string() + (o.warpGrid ? 'w' : '-') + (o.blendMask ? 'b' : '-') +
               (o.fishIds ? 'i' : '-') + (o.help ? 'h' : '-');
    };
    EXPECT_EQ(shown(), "----");
    std::string expected = "----";
    for (std::size_t i = 0; i < 4; ++i) {
        const char key = "wbih"[i];
        controls_.press(key);
        expected[i] = key;
        EXPECT_EQ(shown(), expected);
    }
    for (const char key : {'w', 'b', 'i', 'h'}) controls_.press(key);
    EXPECT_EQ(shown(), "----");
    EXPECT_TRUE(events_.empty());
}

TEST(KeyHelp, isWrittenInLettersThatTheFontHas) {
    for (const std::string_view line : kKeyHelp)
        for (const char character : line)
            EXPECT_TRUE(character == ' ' || glyphOf(character) != 0) << character;
}

TEST(Font, everyDigitAndCapitalHasAShapeOfItsOwn) {
    const std::string all = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ";
    for (const char a : all) {
        EXPECT_NE(glyphOf(a), 0U) << a;
        EXPECT_LT(glyphOf(a), GlyphBits{1} << (kGlyphColumns * kGlyphRows)) << a;
        EXPECT_EQ(std::ranges::count(all, glyphOf(a), glyphOf), 1) << a;
    }
    EXPECT_EQ(glyphOf('?'), 0U);
}

}  // namespace
}  // namespace aquarama
