// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/controls.h"

#include <algorithm>
#include <cctype>
#include <string>

#include <gtest/gtest.h>

#include "render_node/gl/context.h"
#include "render_node/show/overlay.h"
#include "tests/render_node/show/fake_session.h"

namespace aquarama::show {
namespace {

class ControlsTest : public testing::Test {
  protected:
    Events events_;
    FakeSession session_{events_, {}};
    Controls controls_{session_, true};
};

TEST_F(ControlsTest, quitGoesToTheWholeShow) {
    controls_.press('q');
    EXPECT_EQ(events_, Events{"quit"});
}

TEST_F(ControlsTest, quitTwiceEndsThisNodeAlone) {
    controls_.press('q');
    controls_.press(gl::kEscapeKey);
    EXPECT_EQ(events_[1], "stop");
}

TEST_F(ControlsTest, whereTheRigForbidsItAKeyEndsNothingAndTheWindowSaysSo) {
    Controls controls(session_, false);
    EXPECT_FALSE(controls.overlays().endRefused);
    for (const char key : {'q', gl::kEscapeKey, 'q'}) controls.press(key);
    EXPECT_EQ(events_, Events{});
    EXPECT_TRUE(controls.overlays().endRefused);
}

// Wanted values, never toggles: what a key asks for depends on what the wall shows.
TEST_F(ControlsTest, freezeAsksForWhatTheWallDoesNotShow) {
    controls_.press('p');
    wire::Show shown;
    shown.frozen = true;
    controls_.show(shown);
    controls_.press(' ');
    EXPECT_EQ(events_, (Events{"freeze", "thaw"}));
}

TEST_F(ControlsTest, eachOverlayIsSwitchedByItsKeyAndBack) {
    const auto shown = [&] {
        const Overlays o = controls_.overlays();
        return std::string() + (o.warpGrid ? 'g' : '-') + (o.blendMask ? 'b' : '-') +
               (o.fishIds ? 'i' : '-') + (o.mind ? 'e' : '-') + (o.help ? 'h' : '-');
    };
    EXPECT_EQ(shown(), "-----");
    std::string expected = "-----";
    for (std::size_t i = 0; i < 5; ++i) {
        const char key = "gbieh"[i];
        controls_.press(key);
        expected[i] = key;
        EXPECT_EQ(shown(), expected);
    }
    for (const char key : {'g', 'b', 'i', 'e', 'h'}) controls_.press(key);
    EXPECT_EQ(shown(), "-----");
    EXPECT_TRUE(events_.empty());
}

TEST_F(ControlsTest, foodIsDroppedBeforeTheMiddleOrWhereTheMouseIsClicked) {
    EXPECT_FALSE(controls_.nextPinch());
    controls_.press('c');
    controls_.click({12, 34});
    ASSERT_EQ(controls_.nextPinch()->place, std::nullopt);
    EXPECT_EQ(controls_.nextPinch()->place, glm::vec2(12, 34));
    EXPECT_FALSE(controls_.nextPinch());
}

TEST_F(ControlsTest, pinchesThatNoFrameTakesAreFew) {
    for (int i = 0; i < 1000; ++i) controls_.press('c');
    int waiting = 0;
    while (controls_.nextPinch()) ++waiting;
    EXPECT_LE(waiting, 16);
    EXPECT_GE(waiting, 1);
}

TEST_F(ControlsTest, knowsWhereTheMousePoints) {
    const net::Moment now{};
    EXPECT_EQ(controls_.pointer(), std::nullopt);
    controls_.point(glm::vec2(5, 6), now);
    EXPECT_EQ(controls_.pointer(), glm::vec2(5, 6));
    controls_.point(std::nullopt, now);
    EXPECT_EQ(controls_.pointer(), std::nullopt);
}

TEST_F(ControlsTest, aMouseThatLiesStillForLongIsNoHand) {
    using std::chrono::seconds;
    const net::Moment begin{seconds(100)};
    controls_.point(glm::vec2(5, 6), begin);
    controls_.point(glm::vec2(5, 6), begin + seconds(15));
    EXPECT_EQ(controls_.heldPointer(begin + seconds(19)), glm::vec2(5, 6));
    EXPECT_EQ(controls_.heldPointer(begin + seconds(21)), std::nullopt);
    controls_.point(glm::vec2(5, 7), begin + seconds(22));
    EXPECT_EQ(controls_.heldPointer(begin + seconds(23)), glm::vec2(5, 7));
}

TEST_F(ControlsTest, keysThatSteerSwitchNothing) {
    for (const char key : {'w', 'a', 's', 'd'}) controls_.press(key);
    const Overlays o = controls_.overlays();
    EXPECT_FALSE(o.warpGrid || o.blendMask || o.fishIds || o.mind || o.help);
    EXPECT_FALSE(controls_.nextPinch());
    EXPECT_TRUE(events_.empty());
}

TEST_F(ControlsTest, whatHandsHoldGoesToTheSubmarine) {
    using std::chrono::milliseconds;
    gl::Hands hands;
    controls_.hold(hands, net::Moment{milliseconds(0)});
    EXPECT_TRUE(session_.steerings_.empty());
    hands.hold(gl::HeldKey::W);
    controls_.hold(hands, net::Moment{milliseconds(20)});
    controls_.hold(hands, net::Moment{milliseconds(40)});
    controls_.hold({}, net::Moment{milliseconds(60)});
    EXPECT_EQ(session_.steerings_, (std::vector<Steering>{{.ahead = 127}, {}}));
}

TEST(KeyHelp, isWrittenInLettersThatTheFontHas) {
    for (const std::string_view line : kKeyHelp)
        for (const char character : line)
            EXPECT_TRUE(character == ' ' || glyphOf(character) != 0) << character;
}

TEST(Font, everyCharacterHasAShapeOfItsOwn) {
    const std::string all = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ.,:;-+/%()<>=[]_*'#";
    for (const char a : all) {
        EXPECT_NE(glyphOf(a), 0U) << a;
        EXPECT_LT(glyphOf(a), GlyphBits{1} << (kGlyphColumns * kGlyphRows)) << a;
        EXPECT_EQ(std::ranges::count(all, glyphOf(a), glyphOf), 1) << a;
    }
    EXPECT_EQ(glyphOf('?'), 0U);
}

}  // namespace
}  // namespace aquarama::show
