// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/terminal_steering.h"

#include <gtest/gtest.h>

namespace aquarama::conductor {
namespace {

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
