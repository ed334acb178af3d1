// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/sender.h"

#include <gtest/gtest.h>

#include "tests/master/conductor/parts.h"
#include "tests/support/messages.h"

namespace aquarama::conductor {
namespace {

// A node ignores what another run of the master says.
TEST(Sender, namesTheRunOfTheMasterInEachMessage) {
    test::Parts parts;
    EXPECT_EQ(parts.sender.session(), test::kRun);
    parts.sender.say("left", test::farewell());
    parts.sender.send("right", parts.sender.packetOf(test::beacon()));
    ASSERT_EQ(parts.sent.size(), 2U);
    EXPECT_EQ(parts.sent[0].peer, "left");
    EXPECT_TRUE(parts.sent[0].message.has_farewell());
    EXPECT_EQ(parts.sent[1].peer, "right");
    EXPECT_TRUE(parts.sent[1].message.has_beacon());
    for (const test::SentMessage& one : parts.sent) EXPECT_EQ(one.message.session(), test::kRun);
}

TEST(Sender, tellsAPeerWhyItIsDismissed) {
    test::Parts parts;
    parts.sender.dismiss("left", "you were silent for too long");
    ASSERT_EQ(parts.sent.size(), 1U);
    EXPECT_EQ(parts.sent[0].message.dismissed().reason(), "you were silent for too long");
}

}  // namespace
}  // namespace aquarama::conductor
