// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/roster.h"

#include <chrono>
#include <string>

#include <gtest/gtest.h>

#include "tests/master/conductor/parts.h"
#include "tests/support/messages.h"

namespace aquarama::conductor {
namespace {

using config::KeyRole;
using config::QualityTier;
using std::chrono::milliseconds;

// The names of roles whose key allows it; a node's is that of channel left.
std::string whoMay(const v1::Envelope& message) {
    std::string names;
    for (const KeyRole role : {KeyRole::Master,
                               KeyRole::Node,
                               KeyRole::Watcher,
                               KeyRole::Visitor,
                               KeyRole::Operator,
                               KeyRole::Crew,
                               KeyRole::Guests,
                               KeyRole::Standby})
        if (maySay({role, role == KeyRole::Node ? "left" : ""}, message))
            names += std::string(config::nameOf(role)) + " ";
    return names;
}

// What each key allows; a window of a node is a visitor's.
TEST(Users, maySayWhatTheirRoleIsFor) {
    EXPECT_EQ(whoMay(test::hello("left")), "node ");
    EXPECT_EQ(whoMay(test::hello("right")), "") << "that is another's channel";
    EXPECT_EQ(whoMay(test::ready(1)), "node ");
    EXPECT_EQ(whoMay(test::prepared(QualityTier::Low)), "node ");
    EXPECT_EQ(whoMay(test::statusRequest()), "watcher operator crew guests ");
    EXPECT_EQ(whoMay(test::input(v1::INPUT_STEER)), "node visitor operator crew guests ");
    EXPECT_EQ(whoMay(test::input(v1::INPUT_DROP_FOOD)), "node visitor operator crew guests ");
    EXPECT_EQ(whoMay(test::input(v1::INPUT_HANDS)), "node visitor operator crew guests ");
    EXPECT_EQ(whoMay(test::input(v1::INPUT_QUIT)), "operator crew ");
    v1::Envelope order;
    order.mutable_order()->mutable_show()->set_black(true);
    EXPECT_EQ(whoMay(order), "operator crew ");
    order.mutable_order()->mutable_sign();
    EXPECT_EQ(whoMay(order), "operator crew guests ");
    order.mutable_order()->mutable_drawing();
    EXPECT_EQ(whoMay(order), "operator crew guests ");
    order.mutable_order()->mutable_moderation();
    EXPECT_EQ(whoMay(order), "operator crew ") << "no visitor lets a drawing in";
    v1::Envelope question;
    question.mutable_drawings_request();
    EXPECT_EQ(whoMay(question), "watcher operator crew guests ");
    v1::Envelope follow;
    follow.mutable_follow();
    EXPECT_EQ(whoMay(follow), "standby ");
    EXPECT_EQ(whoMay(test::present(1, 0)), "") << "nobody but the master says it";
}

TEST(Users, areNamedByRoleAndName) {
    const auto user = userIn(userOf(KeyRole::Node, "left"));
    ASSERT_TRUE(user);
    EXPECT_EQ(user->role, KeyRole::Node);
    EXPECT_EQ(user->name, "left");
    for (const char* wrong : {"", "node", "king left", " left"})
        EXPECT_FALSE(userIn(wrong)) << wrong;
}

TEST(Roster, hasASeatForEachChannelThatTakesPart) {
    const test::Parts parts;
    EXPECT_EQ(parts.roster.listed([](const NodeSeat&) { return true; }), "left, middle, right");
    EXPECT_EQ(parts.roster.named("right"), 2U);
    EXPECT_FALSE(parts.roster.named("ceiling"));
    const Roster two(test::deskRig(), {"left", "right"});
    EXPECT_EQ(two.seats().size(), 2U);
    EXPECT_FALSE(two.named("middle"));
}

TEST(Roster, isEmptyWhereNoNodeIsThere) {
    test::Parts parts;
    EXPECT_TRUE(parts.roster.isEmpty());
    NodeSeat& left = parts.join("left");
    EXPECT_FALSE(parts.roster.isEmpty());
    left.report = std::make_shared<const v1::NodeReport>();
    left.vacate();
    EXPECT_TRUE(parts.roster.isEmpty());
    EXPECT_FALSE(left.prepared);
    EXPECT_FALSE(left.report) << "it is a report of the node that has gone";
}

// A cable that is plugged in again is another connection of the same node.
TEST(Roster, knowsANodeByItsKeyOverAnotherConnection) {
    test::Parts parts;
    parts.join("left");
    const net::FromPeer again{.peer = "another", .bytes = {}, .user = "node left"};
    EXPECT_FALSE(parts.roster.speaker(again, false)) << "a node of an earlier run";
    EXPECT_FALSE(parts.roster.of("another"));
    EXPECT_EQ(parts.roster.speaker(again, true), 0U);
    EXPECT_EQ(parts.seat("left").peer, "another");
}

TEST(Roster, takesNobodyElseForANode) {
    test::Parts parts;
    parts.join("left");
    const auto speaker = [&](const std::string& user) {
        return parts.roster.speaker({.peer = "another", .bytes = {}, .user = user}, true);
    };
    EXPECT_FALSE(speaker("")) << "without a key";
    EXPECT_FALSE(speaker("operator left"));
    EXPECT_FALSE(speaker("node ceiling"));
    EXPECT_FALSE(speaker("node right")) << "it has not said hello";
    EXPECT_EQ(parts.seat("left").peer, "peer of left");
    EXPECT_TRUE(parts.seat("right").peer.empty());
}

TEST(Roster, hasATierOfTheWallWhenEveryNodeHasMeasuredOne) {
    test::Parts parts;
    EXPECT_EQ(parts.roster.finestTier(), QualityTier::Low) << "nobody has measured";
    parts.seat("left").bears = QualityTier::Ultra;
    parts.seat("middle").bears = QualityTier::Medium;
    EXPECT_FALSE(parts.roster.measuredTier());
    EXPECT_EQ(parts.roster.finestTier(), QualityTier::Medium);
    parts.seat("right").bears = QualityTier::High;
    EXPECT_EQ(parts.roster.measuredTier(), QualityTier::Medium);
}

TEST(Roster, answersAKeyTwoHundredTimesASecond) {
    test::Parts parts;
    const auto answered = [&](const std::string& user, net::Moment now) {
        int count = 0;
        for (int i = 0; i < 300; ++i) count += parts.roster.isWithinRate(user, now) ? 1 : 0;
        return count;
    };
    EXPECT_EQ(answered("operator anna", test::kStart), 200);
    EXPECT_EQ(answered("operator anna", test::kStart + milliseconds(900)), 0);
    EXPECT_EQ(answered("operator ben", test::kStart), 200) << "another key";
    EXPECT_EQ(answered("operator anna", test::kStart + milliseconds(1100)), 200);
    EXPECT_EQ(answered("", test::kStart), 300) << "an account of this machine";
}

TEST(Roster, saysOnceWhyItRefuses) {
    test::Parts parts;
    EXPECT_TRUE(parts.roster.isFirstRefusalOf("visitor 1"));
    EXPECT_FALSE(parts.roster.isFirstRefusalOf("visitor 1"));
    EXPECT_TRUE(parts.roster.isFirstRefusalOf("visitor 2"));
    int told = 0;
    for (int i = 0; i < 300; ++i)
        told += parts.roster.isFirstObjection("build " + std::to_string(i)) ? 1 : 0;
    EXPECT_EQ(told, 100) << "a stranger must not fill the log";
    EXPECT_FALSE(parts.roster.isFirstObjection("build 0"));
}

}  // namespace
}  // namespace aquarama::conductor
