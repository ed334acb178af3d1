// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/orders.h"

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "tests/master/conductor/parts.h"

namespace aquarama::conductor {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::HasSubstr;
using Reply = v1::OrderReply;

OrderLimits limits() {
    OrderLimits show;
    show.wanted.set_scene("reef");
    show.wanted.set_quality(v1::WantedShow::LOW);
    return show;
}

v1::Order blackOrder(bool on) {
    v1::Order order;
    order.mutable_show()->set_black(on);
    return order;
}

v1::Order brightnessOrder(double share) {
    v1::Order order;
    order.mutable_show()->set_brightness(share);
    return order;
}

v1::Order sceneOrder(const std::string& name) {
    v1::Order order;
    order.mutable_show()->set_scene(name);
    return order;
}

v1::Order restart(const std::string& channel) {
    v1::Order order;
    order.mutable_restart()->set_channel(channel);
    return order;
}

v1::Order reboot(const std::string& channel) {
    v1::Order order;
    order.set_run(test::kRun);
    order.mutable_power()->set_channel(channel);
    order.mutable_power()->set_word(v1::Power::REBOOT);
    return order;
}

v1::Order scan(std::uint64_t holder, std::optional<std::uint16_t> number) {
    v1::Order order;
    order.mutable_scan()->set_holder(holder);
    if (number)
        wire::writeScanPattern({.number = *number}, *order.mutable_scan()->mutable_pattern());
    return order;
}

// A sign of two dots; without them it is taken down.
v1::Order sign(const std::string& dots) {
    v1::Order order;
    v1::HeldSign& held = *order.mutable_sign();
    if (dots.empty()) return order;
    held.mutable_sign()->set_columns(2);
    held.mutable_sign()->set_rows(1);
    held.mutable_sign()->set_dots(dots);
    return order;
}

v1::Order guests(bool on) {
    v1::Order order;
    order.mutable_show()->set_guests(on);
    return order;
}

v1::Order release(const std::string& species) {
    v1::Order order;
    order.mutable_release()->set_species(species);
    return order;
}

v1::Order day(v1::WantedShow::Day wanted) {
    v1::Order order;
    order.mutable_show()->set_day(wanted);
    return order;
}

v1::Order colourOrder(double share) {
    v1::Order order;
    order.mutable_show()->set_colour_returned(share);
    return order;
}

// The orders of a desk whose three nodes take part.
class DeskOrders : public testing::Test {
  protected:
    DeskOrders() {
        for (const char* name : {"left", "middle", "right"}) parts.join(name);
    }
    Reply give(std::uint64_t request, v1::Order order) {
        order.set_request(request);
        return orders.obey("operator anna", order, unpublished, now);
    }
    void report(const std::string& channel, bool takesPowerWord) {
        v1::NodeReport report;
        report.set_takes_power_word(takesPowerWord);
        parts.seat(channel).report = std::make_shared<const v1::NodeReport>(report);
    }
    void answer(const std::string& channel, std::uint64_t request, Reply::Outcome outcome) {
        Reply reply;
        reply.set_request(request);
        reply.set_outcome(outcome);
        reply.set_reason(outcome == Reply::REFUSED ? "it takes no word" : "");
        orders.hear(parts.roster.named(channel).value(), reply);
    }
    void pass(net::Duration time) {
        now += time;
        orders.giveUpTheSilent(now);
    }

    test::Parts parts;
    Drawings drawings{std::nullopt, {}};
    Orders orders{limits(), parts.roster, parts.sender, drawings};
    net::Moment now = test::kStart;
    Frame unpublished{40};
};

TEST_F(DeskOrders, aSignIsShownUntilItsHolderTakesItDownOrFallsSilent) {
    EXPECT_EQ(orders.sign().sign(), nullptr);
    EXPECT_EQ(give(1, sign("\x80")).outcome(), Reply::DONE);
    ASSERT_NE(orders.sign().sign(), nullptr);
    EXPECT_EQ(orders.sign().sign()->dots(), "\x80");
    EXPECT_EQ(give(1, sign("\x40")).outcome(), Reply::DONE) << "said again, with others";
    EXPECT_EQ(orders.sign().sign()->dots(), "\x40");
    EXPECT_EQ(give(2, sign("")).outcome(), Reply::DONE);
    EXPECT_EQ(orders.sign().sign(), nullptr);
    give(3, sign("\x80"));
    pass(seconds(4));
    EXPECT_NE(orders.sign().sign(), nullptr);
    pass(seconds(2));
    EXPECT_EQ(orders.sign().sign(), nullptr);
}

TEST_F(DeskOrders, aSignIsRefusedWhereItLiesAndWhileGuestsAreOff) {
    EXPECT_THAT(give(1, sign("\x80\x80")).reason(), HasSubstr("columns and rows"));
    EXPECT_EQ(give(2, guests(false)).outcome(), Reply::DONE);
    EXPECT_THAT(give(3, sign("\x80")).reason(), HasSubstr("set guests on"));
    EXPECT_EQ(give(4, guests(true)).outcome(), Reply::DONE);
    EXPECT_EQ(give(5, sign("\x80")).outcome(), Reply::DONE);
}

TEST_F(DeskOrders, aHunterIsReleasedOnceForEachRequest) {
    EXPECT_EQ(give(1, release("shark")).reason(),
              "no hunter patrols in this scene; set one that has a shark");
    orders.hunters().enter({{"shark", 5}, {"barracuda", 9}});
    EXPECT_EQ(give(2, release("clownfish")).reason(),
              "no clownfish patrols in this scene, only shark, barracuda");
    EXPECT_TRUE(orders.hunters().take().empty());
    EXPECT_EQ(give(3, release("barracuda")).outcome(), Reply::DONE);
    EXPECT_EQ(give(3, release("barracuda")).outcome(), Reply::DONE) << "said again";
    const std::vector<world::ReleaseHunter> called = orders.hunters().take();
    ASSERT_EQ(called.size(), 1U);
    EXPECT_EQ(called[0].species, 9U);
    v1::Order freeze;
    freeze.mutable_show()->set_freeze(true);
    EXPECT_EQ(give(4, freeze).outcome(), Reply::DONE);
    EXPECT_EQ(give(5, release("shark")).reason(), "the world is frozen; set freeze off");
}

TEST_F(DeskOrders, aTimeOfDayHoldsAtOnceAndIsKept) {
    EXPECT_EQ(orders.control().wanted().day(), v1::WantedShow::CLOCK);
    EXPECT_EQ(give(1, day(v1::WantedShow::DUSK)).outcome(), Reply::DONE);
    EXPECT_EQ(orders.control().wanted().day(), v1::WantedShow::DUSK);
    EXPECT_EQ(orders.control().kept().day(), v1::WantedShow::DUSK);
    EXPECT_EQ(give(2, sceneOrder("lagoon")).outcome(), Reply::WAITING);
    EXPECT_EQ(orders.control().next().day(), v1::WantedShow::DUSK) << "in the next scene too";
}

// The log has one line of it.
TEST_F(DeskOrders, aFaderIsInTheLogOnceItRests) {
    std::vector<std::string> said;
    setLogListener([&](Severity, const std::string& line) { said.push_back(line); });
    std::uint64_t request = 0;
    for (int step = 0; step < 20; ++step, pass(std::chrono::milliseconds(100)))
        give(++request, colourOrder(0.01 * step));
    pass(seconds(2));
    pass(seconds(2));
    setLogListener(nullptr);
    EXPECT_THAT(said, testing::ElementsAre("operator anna sets colour 0.19"));
}

TEST_F(DeskOrders, blackIsDoneAtOnceAndOnceForEachRequest) {
    EXPECT_EQ(give(1, blackOrder(true)).outcome(), Reply::DONE);
    EXPECT_TRUE(orders.control().wanted().black());
    EXPECT_EQ(give(2, blackOrder(false)).outcome(), Reply::DONE);
    EXPECT_EQ(give(1, blackOrder(true)).outcome(), Reply::DONE) << "a packet that came late";
    EXPECT_FALSE(orders.control().wanted().black());
}

TEST_F(DeskOrders, anOrderToAnotherRunIsRefusedWhateverItAsks) {
    report("left", true);
    std::uint64_t request = 0;
    for (v1::Order order : {blackOrder(true), scan(7, 3), restart("left"), reboot("left")}) {
        order.set_run(test::kRun + 1);
        EXPECT_THAT(give(++request, order).reason(), HasSubstr("the show was started again"));
    }
    EXPECT_FALSE(orders.control().wanted().black());
    EXPECT_FALSE(orders.scan().pattern());
    EXPECT_TRUE(parts.sent.empty());
}

TEST_F(DeskOrders, nothingIsOrderedOfAShowInLockstep) {
    OrderLimits lockstep = limits();
    lockstep.isLockstep = true;
    Orders same(lockstep, parts.roster, parts.sender, drawings);
    std::uint64_t request = 0;
    for (v1::Order order :
         {blackOrder(true), scan(7, 3), restart("left"), reboot("left"), release("shark")}) {
        order.set_request(++request);
        const Reply reply = same.obey("somebody here", order, unpublished, now);
        EXPECT_EQ(reply.outcome(), Reply::REFUSED);
        EXPECT_THAT(reply.reason(), HasSubstr("lockstep"));
    }
    EXPECT_TRUE(parts.sent.empty());
}

TEST_F(DeskOrders, aSceneIsWaitedForUntilItIsShown) {
    EXPECT_EQ(give(1, sceneOrder("lagoon")).outcome(), Reply::WAITING);
    EXPECT_EQ(give(2, sceneOrder("pond")).outcome(), Reply::REFUSED);
    orders.control().made();
    orders.control().setWaitingFor("prepared by all nodes but left");
    EXPECT_EQ(give(1, sceneOrder("lagoon")).reason(), "prepared by all nodes but left");
    orders.control().prepared();
    orders.control().blackShown();
    orders.control().switched();
    EXPECT_EQ(give(1, sceneOrder("lagoon")).outcome(), Reply::DONE);
    EXPECT_EQ(orders.control().wanted().scene(), "lagoon");
}

TEST_F(DeskOrders, whatCannotBeShownIsRefusedWithAReason) {
    EXPECT_THAT(give(1, sceneOrder("scenes/reef")).reason(), HasSubstr("without folder"));
    EXPECT_THAT(give(2, sceneOrder("reef.txtpb")).reason(), HasSubstr("without folder"));
    v1::Order quality;
    quality.mutable_show()->set_quality(v1::WantedShow::AUTO);
    EXPECT_THAT(give(3, quality).reason(), HasSubstr("not every node has measured"));
    for (NodeSeat& seat : parts.roster.seats()) seat.bears = config::QualityTier::High;
    EXPECT_EQ(give(4, quality).outcome(), Reply::WAITING);
    OrderLimits recorded = limits();
    recorded.whyOneScene = "a recording has one scene";
    Orders one(recorded, parts.roster, parts.sender, drawings);
    v1::Order lagoon = sceneOrder("lagoon");
    lagoon.set_request(5);
    EXPECT_EQ(one.obey("operator anna", lagoon, unpublished, now).reason(),
              "a recording has one scene");
}

TEST_F(DeskOrders, aRestartIsPassedOnAsItCameAndOnce) {
    EXPECT_EQ(give(1, restart("left")).outcome(), Reply::DONE);
    EXPECT_EQ(give(1, restart("left")).outcome(), Reply::DONE) << "said again";
    ASSERT_EQ(parts.sent.size(), 1U);
    EXPECT_EQ(parts.sent[0].peer, "peer of left");
    EXPECT_EQ(parts.sent[0].message.order().request(), 1U);
    EXPECT_EQ(parts.sent[0].message.order().restart().channel(), "left");
}

TEST_F(DeskOrders, aNodeThatIsNotThereIsNotRestarted) {
    parts.seat("right").vacate();
    EXPECT_EQ(give(1, restart("right")).reason(), "right is absent: start it on its machine");
    EXPECT_EQ(give(2, restart("nobody")).reason(), "the rig has no channel nobody");
    EXPECT_TRUE(parts.sent.empty());
}

TEST_F(DeskOrders, aMachineIsSwitchedOnlyWhereItSaysThatItCanBe) {
    EXPECT_THAT(give(1, reboot("left")).reason(), HasSubstr("nothing is known"));
    report("left", false);
    EXPECT_THAT(give(2, reboot("left")).reason(), HasSubstr("takes no such word"));
    EXPECT_TRUE(parts.sent.empty());
    report("left", true);
    EXPECT_EQ(give(3, reboot("left")).outcome(), Reply::WAITING);
    EXPECT_EQ(give(3, reboot("left")).outcome(), Reply::WAITING) << "said again";
    EXPECT_EQ(parts.count("left", v1::Envelope::kOrder), 1);
}

TEST_F(DeskOrders, theNodeThatWasToldSaysWhatBecameOfItsMachine) {
    report("left", true);
    for (const std::uint64_t request : {1, 2})
        EXPECT_EQ(give(request, reboot("left")).outcome(), Reply::WAITING);
    answer("right", 1, Reply::DONE);
    EXPECT_EQ(give(1, reboot("left")).outcome(), Reply::WAITING) << "another node was not told";
    answer("left", 1, Reply::DONE);
    EXPECT_EQ(give(1, reboot("left")).outcome(), Reply::DONE);
    answer("left", 1, Reply::REFUSED);
    EXPECT_EQ(give(1, reboot("left")).outcome(), Reply::DONE) << "it has ended";
    answer("left", 2, Reply::REFUSED);
    EXPECT_EQ(give(2, reboot("left")).reason(), "it takes no word");
}

// It may have been carried out, so that it is never sent again.
TEST_F(DeskOrders, aPowerOrderThatNobodyAnswersIsLostAndNotSentAgain) {
    report("left", true);
    EXPECT_EQ(give(1, reboot("left")).outcome(), Reply::WAITING);
    pass(milliseconds(2900));
    EXPECT_EQ(give(1, reboot("left")).outcome(), Reply::WAITING);
    pass(milliseconds(100));
    const Reply reply = give(1, reboot("left"));
    EXPECT_EQ(reply.outcome(), Reply::LOST);
    EXPECT_EQ(reply.reason(), "the machine of left has not answered; look whether it ends");
    EXPECT_EQ(parts.count("left", v1::Envelope::kOrder), 1);
}

TEST_F(DeskOrders, aScanIsDoneWhenEveryChannelHasShownItsPattern) {
    parts.seat("right").vacate();
    parts.seat("left").released = Frame{40};
    EXPECT_EQ(give(1, scan(7, 3)).reason(), "not shown yet by middle (late), right (absent)");
    EXPECT_EQ(orders.scan().first(), Frame{40});
    parts.join("right").released = Frame{41};
    parts.seat("middle").released = Frame{43};
    const Reply reply = give(1, scan(7, 3));
    EXPECT_EQ(reply.outcome(), Reply::DONE);
    EXPECT_EQ(reply.frame(), 43U);
    EXPECT_EQ(give(2, scan(7, std::nullopt)).outcome(), Reply::DONE);
    EXPECT_FALSE(orders.scan().pattern());
}

TEST_F(DeskOrders, aScanHasTheWallForItself) {
    EXPECT_EQ(give(1, scan(7, 3)).outcome(), Reply::WAITING);
    EXPECT_THAT(give(2, scan(8, 3)).reason(), HasSubstr("another scan holds the wall"));
    EXPECT_THAT(give(3, sceneOrder("lagoon")).reason(), HasSubstr("a scan holds the wall"));
    EXPECT_EQ(give(4, blackOrder(true)).outcome(), Reply::DONE) << "the wall may always go black";
    EXPECT_THAT(give(5, scan(7, 4)).reason(), HasSubstr("the wall is set black"));
    pass(seconds(4));
    EXPECT_FALSE(orders.scan().pattern()) << "its holder has fallen silent";
    give(6, blackOrder(false));
    give(7, sceneOrder("lagoon"));
    EXPECT_THAT(give(8, scan(7, 4)).reason(), HasSubstr("another change is under way"));
}

TEST_F(DeskOrders, aScanHasFullLight) {
    EXPECT_EQ(give(1, brightnessOrder(0.5)).outcome(), Reply::DONE);
    EXPECT_THAT(give(2, scan(7, 3)).reason(), HasSubstr("set brightness 1 for a scan"));
    give(3, brightnessOrder(1));
    EXPECT_EQ(give(4, scan(7, 3)).outcome(), Reply::WAITING);
    EXPECT_THAT(give(5, brightnessOrder(0.5)).reason(), HasSubstr("a scan holds the wall"));
}

}  // namespace
}  // namespace aquarama::conductor
