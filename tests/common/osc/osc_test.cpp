// SPDX-License-Identifier: Apache-2.0
#include "common/osc/osc.h"

#include <cmath>
#include <limits>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/common/osc/sample_packets.h"

namespace aquarama {
namespace {

using osc::OscMessage;
using test::oscBundle;
using test::oscMessage;
using test::oscText;
using test::oscWord;

osc::OscPacket decoded(const std::string& bytes) {
    return osc::decode(std::as_bytes(std::span(bytes)));
}

std::string onePacket(const OscMessage& message) {
    const std::vector<std::byte> bytes = osc::encode(message);
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

TEST(Osc, everyTypeIsRead) {
    const std::string long64 = oscWord(1) + oscWord(2);
    const std::string half = oscWord(0x3F000000), half64 = oscWord(0x3FE00000) + oscWord(0);
    const auto packet = decoded(oscMessage(
        "/a",
        "ifsSTFhdt",
        oscWord(0xFFFFFFFF) + half + oscText("reef") + oscText("") + long64 + half64 + long64));
    EXPECT_EQ(packet.problem, "");
    ASSERT_EQ(packet.messages.size(), 1U);
    const std::int64_t large = (std::int64_t{1} << 32) + 2;
    EXPECT_EQ(packet.messages[0],
              (OscMessage{"/a",
                          {std::int64_t{-1},
                           0.5,
                           "reef",
                           "",
                           std::int64_t{1},
                           std::int64_t{0},
                           large,
                           0.5,
                           large}}));
}

TEST(Osc, aMessageComesBackAsItWasWritten) {
    for (const OscMessage& message :
         {OscMessage{"/aquarama/black", {std::int64_t{1}}},
          OscMessage{"/a", {}},
          OscMessage{"/a/b", {0.25, "three", std::int64_t{-4}, std::int64_t{1} << 40}}}) {
        const auto packet = decoded(onePacket(message));
        EXPECT_EQ(packet.problem, "");
        EXPECT_EQ(packet.messages, std::vector{message});
    }
    EXPECT_EQ(onePacket({"/a", {std::int64_t{7}, 0.5, "x"}}),
              oscMessage("/a", "ifs", oscWord(7) + oscWord(0x3F000000) + oscText("x")));
}

TEST(Osc, bundlesAreOpenedInTheirOrder) {
    const std::string one = oscMessage("/1", ""), two = oscMessage("/2", ""),
                      three = oscMessage("/3", "");
    const auto packet = decoded(oscBundle({one, oscBundle({two}), three, oscBundle({})}));
    EXPECT_EQ(packet.problem, "");
    EXPECT_EQ(packet.messages, (std::vector<OscMessage>{{"/1", {}}, {"/2", {}}, {"/3", {}}}));
}

TEST(Osc, aPacketIsRefusedWholeWithItsReason) {
    const std::string good = oscMessage("/a", "i", oscWord(1));
    std::string deep = good;
    for (int i = 0; i <= osc::kMostDepth; ++i) deep = oscBundle({deep});
    const std::string manyTags(osc::kMostArguments + 1, 'T');
    for (const auto& [bytes, why] : std::vector<std::pair<std::string, std::string>>{
             {"", "it begins with no address, as /aquarama/black"},
             {oscText("a") + oscText(","), "it begins with no address, as /aquarama/black"},
             {std::string("/abc"), "it begins with no address, as /aquarama/black"},
             {std::string("/a\0x", 4) + oscText(","),
              "it begins with no address, as /aquarama/black"},
             {oscMessage("/a b", ""), "it begins with no address, as /aquarama/black"},
             {oscMessage("/\xC3\xA4", ""), "it begins with no address, as /aquarama/black"},
             {oscText("/a"), "/a has no type tags"},
             {oscText("/a") + oscText("i") + oscWord(1), "/a has no type tags"},
             {oscMessage("/a", "i"),
              "/a has an argument that is cut off, or no i, h, f, d, s, S, t, T or F"},
             {oscMessage("/a", "b", oscWord(0)),
              "/a has an argument that is cut off, or no i, h, f, d, s, S, t, T or F"},
             {oscMessage("/a", "s", "text"),
              "/a has an argument that is cut off, or no i, h, f, d, s, S, t, T or F"},
             {good + oscWord(0), "/a has more bytes than its type tags say"},
             {oscMessage("/a", manyTags), "/a has more than 128 arguments"},
             {oscText("#bundle"), "a bundle is cut off"},
             {oscBundle({good}) + oscWord(0), "a bundle is cut off"},
             {oscBundle({good}) + oscWord(0xFFFFFFFF) + good, "a bundle is cut off"},
             {oscBundle({good, "/abc"}), "it begins with no address, as /aquarama/black"},
             {deep, "its bundles lie too deep in one another"},
             {oscBundle(std::vector<std::string>(osc::kMostMessages + 1, oscMessage("/a", ""))),
              "it has more than 128 messages"},
             {oscMessage("/" + std::string(osc::kMostPacketBytes, 'a'), ""),
              "it is larger than 8192 bytes"}}) {
        const auto packet = decoded(bytes);
        EXPECT_EQ(packet.problem, why);
        EXPECT_TRUE(packet.messages.empty()) << why;
    }
}

TEST(Osc, noCutOfAPacketIsRead) {
    const std::string whole =
        oscMessage("/a", "ish", oscWord(1) + oscText("reef") + oscWord(0) + oscWord(1));
    for (std::size_t size = 0; size < whole.size(); ++size)
        EXPECT_NE(decoded(whole.substr(0, size)).problem, "") << size;
    EXPECT_EQ(decoded(whole).problem, "");
}

TEST(Osc, numbersThatAreNoneAreReadAsSuch) {
    const auto packet = decoded(oscMessage("/a", "ff", oscWord(0x7FC00000) + oscWord(0x7F800000)));
    ASSERT_EQ(packet.messages.size(), 1U);
    EXPECT_TRUE(std::isnan(std::get<double>(packet.messages[0].arguments[0])));
    EXPECT_TRUE(std::isinf(std::get<double>(packet.messages[0].arguments[1])));
}

}  // namespace
}  // namespace aquarama
