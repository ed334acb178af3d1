// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/steering.h"

#include <chrono>

#include <gtest/gtest.h>

namespace aquarama::conductor {
namespace {

using std::chrono::milliseconds;

constexpr Steering kAhead{.ahead = 127};
constexpr Steering kBack{.ahead = -127};
constexpr Steering kNothing{};

class InputArbitrationTest : public testing::Test {
  protected:
    bool says(const net::PeerId& who, const PilotHand& hand, int laterMs = 40) {
        now_ += milliseconds(laterMs);
        return arbitration_.accepts(who, hand, now_);
    }
    bool says(const net::PeerId& who, const Steering& what, int laterMs = 40) {
        return says(who, PilotHand{.steering = what}, laterMs);
    }
    InputArbitration arbitration_;
    net::Moment now_{milliseconds(1000)};
};

TEST_F(InputArbitrationTest, oneHandIsHeardUntilItLetsGo) {
    EXPECT_FALSE(says("a", kNothing)) << "it held nothing";
    EXPECT_TRUE(says("a", kAhead));
    EXPECT_TRUE(says("a", kBack));
    EXPECT_EQ(arbitration_.pilot(now_), "a");
    EXPECT_TRUE(says("a", kNothing)) << "the submarine must hear that it lets go";
    EXPECT_EQ(arbitration_.pilot(now_), std::nullopt);
    EXPECT_FALSE(says("a", kNothing));
}

TEST_F(InputArbitrationTest, theLatestThatTakesHoldWins) {
    EXPECT_TRUE(says("a", kAhead));
    EXPECT_TRUE(says("b", kBack));
    EXPECT_FALSE(says("a", kAhead)) << "it holds on, but b came later";
    EXPECT_FALSE(says("a", kNothing)) << "nor does its letting go let b's go";
    EXPECT_EQ(arbitration_.pilot(now_), "b");
    EXPECT_TRUE(says("a", kAhead)) << "it takes hold anew";
    EXPECT_FALSE(says("b", kBack));
    EXPECT_TRUE(says("a", kNothing));
    EXPECT_TRUE(says("b", kBack)) << "still held, and nobody has control";
}

TEST_F(InputArbitrationTest, aPhoneYieldsToEveryOtherHand) {
    const PilotHand phone{.steering = kAhead, .yields = true};
    EXPECT_TRUE(says("phone", phone));
    EXPECT_TRUE(says("a", kBack)) << "takes over from the phone";
    EXPECT_FALSE(says("phone", phone));
    EXPECT_FALSE(says("phone", {kNothing, true}));
    EXPECT_FALSE(says("phone", phone)) << "nor where it takes hold anew";
    EXPECT_TRUE(says("a", kNothing));
    EXPECT_TRUE(says("phone", phone)) << "nobody else steers";
    EXPECT_FALSE(says("other phone", kNothing));
    EXPECT_TRUE(says("other phone", phone)) << "the latest of two phones";
}

TEST_F(InputArbitrationTest, aHandThatFallsSilentLosesTheHelm) {
    EXPECT_TRUE(says("a", kAhead));
    EXPECT_TRUE(says("b", kBack));
    EXPECT_EQ(arbitration_.pilot(now_ + milliseconds(600)), std::nullopt);
    EXPECT_TRUE(says("a", kAhead, 600));
}

TEST_F(InputArbitrationTest, aFloodIsHeardNowAndThenAndItsEndAtOnce) {
    int heard = 0;
    for (int i = 0; i < 1000; ++i) heard += says("a", kAhead, 1) ? 1 : 0;
    EXPECT_LE(heard, 130);
    EXPECT_GE(heard, 50);
    EXPECT_TRUE(says("a", kNothing, 0));
}

TEST_F(InputArbitrationTest, whoOnlyTriesToBeRememberedIsNot) {
    int heard = 0;
    for (int i = 0; i < 10000; ++i) heard += says(std::to_string(i), kAhead, 0) ? 1 : 0;
    EXPECT_LE(heard, 256);
}

TEST(TerminalSteering, eachKeyIsANotchOfItsAxisUpToFull) {
    TerminalSteering terminal;
    terminal.press("w");
    EXPECT_EQ(terminal.steering(), (Steering{.ahead = 127 / 4}));
    EXPECT_EQ(terminal.text(), "ahead 1/4");
    terminal.press("wwwwwww");
    EXPECT_EQ(terminal.steering(), (Steering{.ahead = 127}));
    terminal.press("ssss");
    EXPECT_EQ(terminal.steering(), Steering{}) << "as many back";
    terminal.press("s\x1b[D\x1b[6~d");
    EXPECT_EQ(terminal.steering(),
              (Steering{.ahead = -127 / 4, .aside = 127 / 4, .up = -127 / 4, .turn = 127 / 4}));
    terminal.press("r");
    EXPECT_EQ(terminal.text(),
              "back 1/4, to the right 1/4, sinking 1/4, turning left 1/4, nose up 1/4");
}

TEST(TerminalSteering, spaceLetsGoOfEverything) {
    TerminalSteering terminal;
    terminal.press("wwdr\x1b[A ");
    EXPECT_EQ(terminal.steering(), Steering{});
    EXPECT_EQ(terminal.text(), "hands off");
    EXPECT_FALSE(terminal.ended());
}

TEST(TerminalSteering, endsAtQEscapeAndInterruptAndPassesOverTheRest) {
    for (const char* end : {"q", "\x1b", "\x03", "wq"}) {
        TerminalSteering terminal;
        terminal.press("zZ\x1b[15~\xff");
        EXPECT_FALSE(terminal.ended());
        EXPECT_EQ(terminal.steering(), Steering{});
        terminal.press(end);
        EXPECT_TRUE(terminal.ended());
    }
}

}  // namespace
}  // namespace aquarama::conductor
