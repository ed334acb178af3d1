// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/telegraph.h"

#include <gtest/gtest.h>

namespace aquarama::conductor {
namespace {

TEST(Telegraph, eachKeyIsANotchOfItsAxisUpToFull) {
    Telegraph telegraph;
    telegraph.press("w");
    EXPECT_EQ(telegraph.steering(), (Steering{.ahead = 127 / 4}));
    EXPECT_EQ(telegraph.text(), "ahead 1/4");
    telegraph.press("wwwwwww");
    EXPECT_EQ(telegraph.steering(), (Steering{.ahead = 127}));
    telegraph.press("ssss");
    EXPECT_EQ(telegraph.steering(), Steering{}) << "as many back";
    telegraph.press("s\x1b[D\x1b[6~d");
    EXPECT_EQ(telegraph.steering(),
              (Steering{.ahead = -127 / 4, .aside = 127 / 4, .up = -127 / 4, .turn = 127 / 4}));
    telegraph.press("r");
    EXPECT_EQ(telegraph.text(),
              "back 1/4, to the right 1/4, sinking 1/4, turning left 1/4, nose up 1/4");
}

TEST(Telegraph, spaceLetsGoOfEverything) {
    Telegraph telegraph;
    telegraph.press("wwdr\x1b[A ");
    EXPECT_EQ(telegraph.steering(), Steering{});
    EXPECT_EQ(telegraph.text(), "hands off");
    EXPECT_FALSE(telegraph.ended());
}

TEST(Telegraph, endsAtQEscapeAndInterruptAndPassesOverTheRest) {
    for (const char* end : {"q", "\x1b", "\x03", "wq"}) {
        Telegraph telegraph;
        telegraph.press("zZ\x1b[15~\xff");
        EXPECT_FALSE(telegraph.ended());
        EXPECT_EQ(telegraph.steering(), Steering{});
        telegraph.press(end);
        EXPECT_TRUE(telegraph.ended());
    }
}

}  // namespace
}  // namespace aquarama::conductor
