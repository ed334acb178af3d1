// SPDX-License-Identifier: Apache-2.0
#include "common/enrol/waiting_node.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/base/log.h"

namespace aquarama::enrol {
namespace {

using namespace std::chrono_literals;
using Kind = Word::Kind;

const std::string kNodeKey(40, 'n');
const net::Moment kStart{1h};

config::KeyFile keyOf(config::KeyRole role) {
    return {.rig = "hall",
            .masterAddress = "tcp://192.168.7.1:7400",
            .masterKey = std::string(40, 'm'),
            .name = "left",
            .role = role,
            .publicKey = std::string(40, 'p'),
            .secretKey = std::string(40, 's'),
            .made = "2026-11-29",
            .revoked = {}};
}

class WaitingNodeTest : public testing::Test {
  protected:
    // What an assigner says who has read this code on the screen of a node of this key.
    static Word proofOf(const std::string& code, const std::string& nodeKey = kNodeKey) {
        return {Kind::Proof, CodeKey(code, nodeKey).proofOf(Side::Assigner)};
    }

    std::vector<config::KeyFile> kept_;
    WaitingNode node_{kNodeKey, kStart, [this](const config::KeyFile& key) {
                          if (key.name == "full") throw Error("the disk is full");
                          kept_.push_back(key);
                      }};
};

TEST_F(WaitingNodeTest, takesTheKeyOfWhoHasReadItsCode) {
    const CodeKey codeKey(node_.code(), kNodeKey);
    const auto proof = node_.hear("console", proofOf(node_.code()), kStart);
    ASSERT_TRUE(proof);
    EXPECT_EQ(proof->kind, Kind::Proof);
    EXPECT_TRUE(codeKey.isProof(Side::Node, proof->content));
    EXPECT_FALSE(codeKey.isProof(Side::Assigner, proof->content));  // an echo proves nothing
    const Word key{Kind::KeyFile, config::textOf(keyOf(config::KeyRole::Node))};
    const auto taken = node_.hear("console", key, kStart);
    ASSERT_TRUE(taken);
    EXPECT_EQ(taken->kind, Kind::Taken);
    ASSERT_EQ(kept_.size(), 1U);
    EXPECT_EQ(kept_.front().secretKey, std::string(40, 's'));
    ASSERT_TRUE(node_.key());
    EXPECT_EQ(node_.key()->name, "left");
}

TEST_F(WaitingNodeTest, giveStrangersNothing) {
    const Word key{Kind::KeyFile, config::textOf(keyOf(config::KeyRole::Node))};
    EXPECT_FALSE(node_.hear("stranger", key, kStart));
    const auto refused = node_.hear("stranger", proofOf("AAAAAAAA"), kStart);
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->kind, Kind::Refused);
    EXPECT_FALSE(node_.hear("stranger", key, kStart));
    // Somebody in between, under whose key an assigner has shown the code.
    const Word overheard = proofOf(node_.code(), std::string(40, 'x'));
    EXPECT_EQ(node_.hear("stranger", overheard, kStart + 2s)->kind, Kind::Refused);
    // Somebody else has shown the code: that opens the door for him alone.
    EXPECT_EQ(node_.hear("console", proofOf(node_.code()), kStart + 4s)->kind, Kind::Proof);
    EXPECT_FALSE(node_.hear("stranger", key, kStart + 4s));
    EXPECT_FALSE(node_.key());
    EXPECT_TRUE(kept_.empty());
}

TEST_F(WaitingNodeTest, guessesAreSlowAndEndTheCode) {
    const std::string code = node_.code();
    net::Moment now = kStart;
    EXPECT_EQ(node_.hear("a", proofOf("WRONG"), now)->kind, Kind::Refused);
    // Even the right code waits for a second.
    EXPECT_EQ(node_.hear("b", proofOf(code), now + 999ms)->kind, Kind::Refused);
    for (int i = 1; i < WaitingNode::kMostWrong; ++i) {
        EXPECT_FALSE(node_.renewCode(now));
        now += 1s;
        EXPECT_EQ(node_.hear("a", {Kind::Proof, "no"}, now)->kind, Kind::Refused);
    }
    EXPECT_TRUE(node_.renewCode(now));
    EXPECT_NE(node_.code(), code);
    EXPECT_EQ(node_.hear("b", proofOf(code), now + 1s)->kind, Kind::Refused);
}

TEST_F(WaitingNodeTest, aCodeLivesTenMinutes) {
    const std::string code = node_.code();
    EXPECT_FALSE(node_.renewCode(kStart + 10min - 1s));
    // Who has shown the old code must show the new one.
    EXPECT_EQ(node_.hear("console", proofOf(code), kStart)->kind, Kind::Proof);
    EXPECT_TRUE(node_.renewCode(kStart + 10min));
    const Word key{Kind::KeyFile, config::textOf(keyOf(config::KeyRole::Node))};
    EXPECT_FALSE(node_.hear("console", key, kStart + 10min));
}

TEST_F(WaitingNodeTest, whatIsNoKeyOfAChannelIsRefusedByName) {
    ASSERT_EQ(node_.hear("console", proofOf(node_.code()), kStart)->kind, Kind::Proof);
    const auto answerTo = [&](const std::string& text) {
        return node_.hear("console", {Kind::KeyFile, text}, kStart).value();
    };
    EXPECT_EQ(answerTo("no key").kind, Kind::Refused);
    const Word operators = answerTo(config::textOf(keyOf(config::KeyRole::Operator)));
    EXPECT_EQ(operators.content, "it takes the key of a channel only");
    config::KeyFile full = keyOf(config::KeyRole::Node);
    full.name = "full";
    EXPECT_EQ(answerTo(config::textOf(full)).content, "the disk is full");
    EXPECT_FALSE(node_.key());
    EXPECT_EQ(answerTo(config::textOf(keyOf(config::KeyRole::Node))).kind, Kind::Taken);
}

TEST(EnrolWords, areReadAsWrittenAndNothingElseIs) {
    for (const Word& word : {Word{Kind::Proof, std::string(32, '\0')},
                             Word{Kind::Taken, ""},
                             Word{Kind::Refused, "why"}}) {
        const auto read = wordIn(packetOf(word));
        ASSERT_TRUE(read);
        EXPECT_EQ(read->kind, word.kind);
        EXPECT_EQ(read->content, word.content);
    }
    EXPECT_FALSE(wordIn({}));
    for (const int kind : {0, 5, 255})
        EXPECT_FALSE(wordIn(std::vector<std::byte>(2, static_cast<std::byte>(kind))));
    EXPECT_TRUE(wordIn(std::vector<std::byte>(kMostWordBytes, std::byte{1})));
    EXPECT_FALSE(wordIn(std::vector<std::byte>(kMostWordBytes + 1, std::byte{1})));
}

}  // namespace
}  // namespace aquarama::enrol
