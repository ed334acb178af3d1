// SPDX-License-Identifier: Apache-2.0
#include "common/tuio/hand_set.h"

#include <limits>
#include <span>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/common/tuio/sample_streams.h"

namespace aquarama::tuio {
namespace {

using test::SampleTouch;
using test::tuio2Frame;
using test::tuioFrame;
using testing::ElementsAre;
using testing::IsEmpty;

// A surface that hears packets as they come from the network.
struct Heard : HandSet {
    void hear(const std::string& packet, double now) {
        const auto read = osc::decode(std::as_bytes(std::span(packet)));
        EXPECT_EQ(read.problem, "");
        HandSet::hear(read.messages, now);
    }
    // Their sessions.
    std::vector<std::int64_t> sessions(double now) const {
        std::vector<std::int64_t> all;
        for (const Hand& hand : seen(now)) all.push_back(hand.session);
        return all;
    }
};

// Of each kind of stream: all tell the same.
using MakeFrame = std::string (*)(std::uint32_t number, const std::vector<SampleTouch>& touches);
const std::vector<MakeFrame> kKinds{
    [](std::uint32_t number, const std::vector<SampleTouch>& touches) {
        return tuioFrame(number, touches, "tracker");
    },
    [](std::uint32_t number, const std::vector<SampleTouch>& touches) {
        return tuioFrame(number, touches, "tracker", true);
    },
    [](std::uint32_t number, const std::vector<SampleTouch>& touches) {
        return tuio2Frame(number, touches);
    },
    [](std::uint32_t number, const std::vector<SampleTouch>& touches) {
        return tuio2Frame(number, touches, "tracker", true);
    }};

TEST(HandSet, aHandComesMovesAndGoes) {
    for (const MakeFrame& frame : kKinds) {
        Heard surface;
        surface.hear(frame(1, {{7, 0.25F, 0.5F, 1, -2}}), 0);
        EXPECT_THAT(surface.seen(0), ElementsAre(Hand{"tracker", 7, {0.25F, 0.5F}, {1, -2}}));
        surface.hear(frame(2, {{7, 0.5F, 0.75F}, {8, 1, 0}}), 0.1);
        EXPECT_THAT(
            surface.seen(0.1),
            ElementsAre(Hand{"tracker", 7, {0.5F, 0.75F}, {}}, Hand{"tracker", 8, {1, 0}, {}}));
        surface.hear(frame(3, {{8, 1, 0}}), 0.2);
        EXPECT_THAT(surface.sessions(0.2), ElementsAre(8));
        surface.hear(frame(4, {}), 0.3);
        EXPECT_THAT(surface.seen(0.3), IsEmpty());
    }
}

TEST(HandSet, lateFramesAreNotHeardAndATrackerMayBeginAgain) {
    for (const MakeFrame& frame : kKinds) {
        Heard surface;
        surface.hear(frame(500, {{1, 0, 0}}), 0);
        surface.hear(frame(499, {{1, 1, 1}, {2, 1, 1}}), 0.1);
        EXPECT_THAT(surface.sessions(0.1), ElementsAre(1)) << "late";
        surface.hear(frame(500, {{1, 0, 0}, {2, 1, 1}}), 0.2);
        EXPECT_THAT(surface.sessions(0.2), ElementsAre(1, 2)) << "goes on";
        surface.hear(frame(1, {{3, 0, 0}}), 0.3);
        EXPECT_THAT(surface.sessions(0.3), ElementsAre(3)) << "started again";
        surface.hear(frame(2, {{4, 0, 0}}), 0.4);
        EXPECT_THAT(surface.sessions(0.4), ElementsAre(4));
    }
}

TEST(HandSet, aFrameThatIsRepeatedCountsAlways) {
    Heard surface;
    surface.hear(tuioFrame(9, {{1, 0, 0}}), 0);
    surface.hear(tuioFrame(0xFFFFFFFF, {{1, 0.5F, 0}, {2, 0, 0}}), 0.1);
    EXPECT_THAT(surface.sessions(0.1), ElementsAre(1, 2));
    surface.hear(tuioFrame(8, {}), 0.2);
    EXPECT_THAT(surface.sessions(0.2), ElementsAre(1, 2)) << "and is no number";
}

TEST(HandSet, aTrackerThatFallsSilentIsForgotten) {
    for (const MakeFrame& frame : kKinds) {
        Heard surface;
        surface.hear(frame(1, {{1, 0, 0}}), 0);
        EXPECT_THAT(surface.sessions(2.1), ElementsAre(1)) << "one repetition was lost";
        EXPECT_THAT(surface.seen(2.6), IsEmpty());
        surface.hear(frame(1, {{2, 0, 0}}), 5);
        EXPECT_THAT(surface.sessions(5), ElementsAre(2)) << "with its number";
    }
}

TEST(HandSet, trackersAndKindsAreListsOfTheirOwn) {
    Heard surface;
    surface.hear(tuioFrame(1, {{1, 0, 0}}, "left"), 0);
    surface.hear(tuioFrame(900, {{1, 1, 1}}, "right"), 0);
    surface.hear(tuioFrame(1, {{5, 0, 0}}, "left", true), 0);
    surface.hear(tuio2Frame(1, {{6, 0, 0}}, "left"), 0);
    EXPECT_THAT(surface.sessions(0), ElementsAre(5, 1, 6, 1));
    surface.hear(tuioFrame(2, {}, "left"), 0.5);
    EXPECT_THAT(surface.sessions(0.5), ElementsAre(5, 6, 1));
}

TEST(HandSet, aPlaceCountsInsideTheSurfaceAndANumberThatIsNoneDoesNot) {
    constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
    constexpr float kEndless = std::numeric_limits<float>::infinity();
    Heard surface;
    surface.hear(
        tuioFrame(
            1, {{1, -0.1F, 1.1F, kNone, 0}, {2, kNone, 0}, {3, 0, kEndless}, {4, 0, 0, 1e9F, 0}}),
        0);
    EXPECT_THAT(surface.seen(0),
                ElementsAre(Hand{"", 1, {0, 1}, {}}, Hand{"", 4, {0, 0}, {100, 0}}));
}

TEST(HandSet, whatIsNoWholeFrameIsPassedOver) {
    using test::oscMessage;
    using test::oscText;
    using test::oscWord;
    const auto cursor = [](const std::string& tags, const std::string& arguments) {
        return oscMessage("/tuio/2Dcur", tags, arguments);
    };
    const std::string end = cursor("si", oscText("fseq") + oscWord(1));
    const std::string one = oscWord(1), half = test::oscNumber(0.5F);
    const std::string set = cursor("siff", oscText("set") + one + half + half);
    Heard surface;
    for (const std::string& packet :
         {test::oscBundle({set, end}),                                   // nobody is alive
          test::oscBundle({cursor("si", oscText("alive") + one), set}),  // it does not end
          test::oscBundle({cursor("si", oscText("alive") + one), end}),  // it has no place
          test::oscBundle({cursor("si", oscText("alive") + one), cursor("s", oscText("set")), end}),
          test::oscBundle({cursor("ss", oscText("alive") + oscText("1")), set, end}),
          cursor("", ""),
          cursor("i", one),
          oscMessage("/tuio/2Dobj", "si", oscText("alive") + one),
          oscMessage("/tuio2/alv", "i", one),
          oscMessage("/tuio2/ptr", "i", one)}) {
        surface.hear(packet, 0);
        EXPECT_THAT(surface.seen(0), IsEmpty());
    }
    surface.hear(test::oscBundle({cursor("si", oscText("alive") + one), set, end}), 0);
    EXPECT_THAT(surface.sessions(0), ElementsAre(1));
}

TEST(HandSet, noMoreThanSixtyFourHandsOfEightTrackersAreKept) {
    std::vector<SampleTouch> many;
    for (std::uint32_t i = 0; i < 60; ++i) many.push_back({i, 0, 0});
    Heard surface;
    surface.hear(tuioFrame(1, many, "a"), 0);
    surface.hear(tuioFrame(1, many, "b"), 0);
    EXPECT_EQ(surface.seen(0).size(), kMostHands);
    for (int i = 0; i < 20; ++i)
        surface.hear(tuioFrame(1, {{1, 0, 0}}, std::string(1, static_cast<char>('c' + i))), 0.5);
    surface.hear(tuioFrame(2, {}, "a"), 0.5);
    surface.hear(tuioFrame(2, {}, "b"), 0.5);
    EXPECT_EQ(surface.seen(0.5).size(), kMostTrackers - 2);
}

// A program draws circles with ten fingers, packets are lost, doubled and swapped.
TEST(HandSet, aStreamOverABadNetworkEndsAsItWasSent) {
    Heard surface;
    std::vector<std::string> sent;
    for (std::uint32_t number = 1; number <= 200; ++number) {
        std::vector<SampleTouch> touches;
        for (std::uint32_t finger = 0; finger < 10; ++finger)
            if (number / 20 >= finger)
                touches.push_back({finger, static_cast<float>(number) / 200, 0.5F});
        sent.push_back(tuioFrame(number, touches));
    }
    for (std::size_t i = 0; i + 1 < sent.size(); ++i) {
        const double now = static_cast<double>(i) / 60;
        if (i % 7 == 3) continue;
        if (i % 5 == 2) surface.hear(sent[i + 1], now);
        surface.hear(sent[i], now);
        if (i % 11 == 4) surface.hear(sent[i], now);
        for (const Hand& hand : surface.seen(now))
            EXPECT_LE(std::abs(hand.place.x - static_cast<float>(i + 1) / 200), 2.0F / 200);
    }
    surface.hear(sent.back(), 4);
    EXPECT_EQ(surface.seen(4).size(), 10U);
    for (const Hand& hand : surface.seen(4)) EXPECT_EQ(hand.place.x, 1);
}

}  // namespace
}  // namespace aquarama::tuio
