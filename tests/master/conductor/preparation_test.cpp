// SPDX-License-Identifier: Apache-2.0
#include "master/conductor/preparation.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "common/ask/request_client.h"
#include "common/base/log.h"
#include "common/wire/messages.h"

namespace aquarama::conductor {
namespace {

constexpr const char* kAny = "tcp://127.0.0.1:*";

// The next message to this peer, five seconds at most; until then it says this.
std::optional<v1::Envelope> nextMessage(net::NodeChannels& node, const wire::Packet& question) {
    const net::Moment end = net::monotonicNow() + std::chrono::seconds(5);
    while (net::monotonicNow() < end) {
        node.sendControl(question);  // lost where the connection does not stand yet
        node.wait(std::chrono::milliseconds(200));
        if (const auto bytes = node.receiveControl()) return wire::decode(*bytes);
    }
    return std::nullopt;
}

TEST(Preparation, whoAsksHearsWhatTheMasterPrepares) {
    const auto channels = net::bindMaster(kAny, kAny);
    Preparation preparation(*channels);
    EXPECT_EQ(preparation.tell("capturing 3 of 7 species, 20 %"),
              "the master prepares: capturing 3 of 7 species, 20 %");
    ask::RequestClient client(channels->controlAddress());
    try {
        static_cast<void>(client.status());
        FAIL() << "a status before there is a show";
    } catch (const Error& problem) {
        EXPECT_STREQ(problem.what(),
                     "the master prepares: capturing 3 of 7 species, 20 %; ask again in a while");
    }
    EXPECT_EQ(client.preparing(), "the master prepares: capturing 3 of 7 species, 20 %");
    v1::Order order;
    order.set_request(1);
    order.mutable_show()->set_black(true);
    EXPECT_THROW(static_cast<void>(client.give(order)), Error);
    preparation.tell("making the world");
    EXPECT_THROW(static_cast<void>(client.explain(1)), Error);
    EXPECT_EQ(client.preparing(), "the master prepares: making the world");
}

TEST(Preparation, aNodeIsDismissedWithThatAndAFloodOfInputsIsNotAnswered) {
    const auto channels = net::bindMaster(kAny, kAny);
    std::optional<Preparation> preparation(std::in_place, *channels);
    preparation->tell("making the world");
    const auto node = net::connectNode(channels->controlAddress());
    v1::Envelope input;
    *input.mutable_input() = wire::steeringInput({.ahead = 1});
    v1::Envelope hello;
    hello.mutable_hello()->set_channel("left");
    hello.mutable_hello()->set_major(wire::kProtocolMajor);
    hello.mutable_hello()->set_build("test");
    hello.mutable_hello()->set_motor_hash(1);
    ASSERT_TRUE(nextMessage(*node, wire::encode(0, hello)));
    while (node->receiveControl()) {
    }
    for (int i = 0; i < 50; ++i) node->sendControl(wire::encode(0, input));
    const auto message = nextMessage(*node, wire::encode(0, hello));
    ASSERT_TRUE(message && message->has_dismissed());
    EXPECT_EQ(message->dismissed().reason(), "the master prepares: making the world");
    EXPECT_FALSE(node->receiveControl());
    // The channels are free for the conductor then.
    preparation.reset();
    node->sendControl(wire::encode(0, hello));
    const net::Moment end = net::monotonicNow() + std::chrono::seconds(5);
    std::optional<net::FromPeer> from;
    while (!from && net::monotonicNow() < end) {
        channels->wait(std::chrono::milliseconds(50));
        from = channels->receiveControl();
    }
    ASSERT_TRUE(from);
    EXPECT_TRUE(wire::decode(from->bytes)->has_hello());
}

}  // namespace
}  // namespace aquarama::conductor
