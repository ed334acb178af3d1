// SPDX-License-Identifier: Apache-2.0
// A desk over sockets of the loopback, without a console around it.
#include "console/cues/osc_desk.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "tests/common/osc/sample_packets.h"
#include "tests/console/cues/free_port.h"

namespace aquarama::console {
namespace {

using config::UdpAddress;
using osc::OscMessage;
using test::freePort;
using test::Port;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using OscReply = v1::OrderReply;
using Outcome = OscReply::Outcome;

std::vector<OscMessage> heardAt(Port& port) {
    std::vector<OscMessage> all;
    while (const auto datagram = port.socket->receive(osc::kMostPacketBytes))
        for (const OscMessage& message : osc::decode(datagram->bytes).messages)
            all.push_back(message);
    return all;
}

OscMessage refusal(const std::string& address, const std::string& why) {
    return {"/aquarama/refused", {address, why}};
}

// A theatre whose desk and stranger are two hosts of the loopback.
class Theatre : public testing::Test {
  protected:
    Theatre() {
        const UdpAddress own = freePort().address;  // is free again
        desk.emplace(config::OscCues{own, {"127.0.0.1"}, {receiver.address}},
                     [this](const std::string& who, const v1::Order& order) {
                         return carryOut(who, order);
                     });
        at = own;
    }
    // As Console::giveOrder(), with the outcome that is set.
    OscReply carryOut(const std::string& who, const v1::Order& order) {
        OscReply reply;
        reply.set_request(order.request() != 0 ? order.request() : ++number);
        reply.set_outcome(outcome);
        if (outcome == OscReply::REFUSED) reply.set_reason("a scan holds the wall");
        said.push_back(who + ": " + wire::textOf(order.show()));
        return reply;
    }
    void send(Port& from, const std::string& bytes) {
        from.socket->send(at, std::as_bytes(std::span(bytes)));
    }
    std::string black(int on) const {
        return test::oscMessage("/aquarama/black", "i", test::oscWord(static_cast<unsigned>(on)));
    }

    Port sender = freePort(), stranger = freePort("127.0.0.2"), receiver = freePort();
    std::optional<OscDesk> desk;
    UdpAddress at;
    void tick() { desk->tick(shownBy(status, isHeard)); }

    v1::StatusReply status;
    bool isHeard = true;
    Outcome outcome = OscReply::DONE;
    std::uint64_t number = 0;
    std::vector<std::string> said;
};

TEST_F(Theatre, aCueOfTheDeskIsAnOrderAndThatOfAStrangerIsDropped) {
    send(sender, black(1));
    send(stranger, black(0));
    tick();
    EXPECT_THAT(said, ElementsAre("OSC 127.0.0.1: black on"));
    EXPECT_EQ(desk->counts().given, 1U);
    EXPECT_EQ(desk->counts().strangers, 1U);
    EXPECT_THAT(heardAt(stranger), IsEmpty()) << "who is no desk is told nothing";
}

TEST_F(Theatre, whatIsNoCueIsRefusedToItsSenderAndChangesNothing) {
    send(sender, test::oscMessage("/aquarama/black", "f", test::oscWord(0x3F800000)));
    send(sender, "no packet");
    send(sender, std::string(9000, 'a'));
    send(sender, test::oscMessage("/aquarama/state/black", "i", test::oscWord(1)));
    send(sender,
         test::oscMessage("/aquarama/refused", "ss", test::oscText("") + test::oscText("")));
    tick();
    EXPECT_THAT(said, IsEmpty());
    EXPECT_EQ(desk->counts().refused, 3U);
    EXPECT_THAT(
        heardAt(sender),
        ElementsAre(refusal("/aquarama/black", "it takes one argument: 1 or 0, a whole number"),
                    refusal("", "it begins with no address, as /aquarama/black"),
                    refusal("", "it is larger than 8192 bytes")))
        << "and to what another console says, nothing";
}

TEST_F(Theatre, ofAFaderTheLastStepOfATickCounts) {
    for (const unsigned bits : {0x3F000000U, 0x3E800000U, 0x3F800000U})
        send(sender, test::oscMessage("/aquarama/brightness", "f", test::oscWord(bits)));
    send(sender, test::oscBundle({black(1), black(0)}));
    tick();
    EXPECT_THAT(said, ElementsAre("OSC 127.0.0.1: black off", "OSC 127.0.0.1: brightness 1.00"));
}

TEST_F(Theatre, anOrderIsFollowedToItsEnd) {
    outcome = OscReply::WAITING;
    send(sender, test::oscMessage("/aquarama/scene", "s", test::oscText("lagoon")));
    tick();
    tick();
    EXPECT_EQ(number, 1U) << "one order, asked for twice";
    EXPECT_EQ(said.size(), 2U);
    EXPECT_THAT(heardAt(sender), IsEmpty());
    outcome = OscReply::REFUSED;
    tick();
    EXPECT_THAT(heardAt(sender), ElementsAre(refusal("/aquarama/scene", "a scan holds the wall")));
    tick();
    EXPECT_EQ(said.size(), 3U) << "it has ended";
}

TEST_F(Theatre, aFloodCostsNoMoreThanItsBounds) {
    outcome = OscReply::WAITING;
    for (int i = 0; i < 200; ++i) send(sender, "no packet");
    tick();
    EXPECT_LE(heardAt(sender).size(), 16U);
    EXPECT_EQ(desk->counts().refused, 200U);
    for (int i = 0; i < 100; ++i) {
        send(sender, black(i % 2));
        tick();
    }
    said.clear();
    tick();
    EXPECT_LE(said.size(), 32U) << "orders that are followed";
}

TEST_F(Theatre, receiversAreToldChangesAtOnceAndAllEveryFiveSeconds) {
    tick();
    EXPECT_EQ(heardAt(receiver).size(), 17U) << "all, first";
    status.set_frame(5);
    tick();
    EXPECT_THAT(heardAt(receiver), IsEmpty()) << "the frame alone is no news";
    isHeard = false;
    tick();
    EXPECT_THAT(heardAt(receiver),
                ElementsAre(OscMessage{"/aquarama/state/running", {std::int64_t{0}}}));
    for (int i = 3; i < 50; ++i) tick();
    EXPECT_THAT(heardAt(receiver), IsEmpty());
    tick();
    const auto all = heardAt(receiver);
    ASSERT_EQ(all.size(), 17U);
    EXPECT_EQ(all[13], (OscMessage{"/aquarama/state/frame", {std::int64_t{5}}}));
}

TEST_F(Theatre, aPortThatAnotherProgramHasIsNamed) {
    try {
        const UdpPort second(at);
        FAIL() << "two listen there";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("cannot listen at udp://127.0.0.1:"));
        EXPECT_THAT(error.what(), HasSubstr("no other program has the port"));
    }
}

TEST(UdpPort, speaksVersion6) {
    try {
        Port one = freePort("::1"), two = freePort("::1");
        const std::string bytes = "hello";
        one.socket->send(two.address, std::as_bytes(std::span(bytes)));
        const auto heard = two.socket->receive(100);
        ASSERT_TRUE(heard);
        EXPECT_EQ(heard->from, one.address);
        EXPECT_EQ(heard->bytes.size(), bytes.size());
    } catch (const Error& error) {
        GTEST_SKIP() << error.what();
    }
}

}  // namespace
}  // namespace aquarama::console
