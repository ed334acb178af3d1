// SPDX-License-Identifier: Apache-2.0
// The same promises for both kinds of channels, and over real sockets what strangers may do.
#include "common/net/channels.h"

#include <csignal>
#include <cstring>
#include <fstream>
#include <random>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zmq.hpp>

#include "common/units/log.h"
#include "tests/support/memory_channels.h"

namespace aquarama::net {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

ByteVector bytes(const std::string& text) {
    const auto view = std::as_bytes(std::span{text});
    return {view.begin(), view.end()};
}

std::string text(const ByteVector& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

struct Pair {
    std::unique_ptr<MasterChannels> master;
    std::unique_ptr<NodeChannels> node;
};

Pair overSockets() {
    auto master = bindMaster("tcp://127.0.0.1:*", "tcp://127.0.0.1:*");
    auto node = connectNode(master->controlAddress());
    return {std::move(master), std::move(node)};
}

Pair inMemory() {
    test::MemoryNet net({milliseconds(2), 0, 1});
    return {net.master(), net.node()};
}

// Waits at `end` until `take` yields something; empty after ten seconds.
template <class End, class Take>
auto await(End& end, Take take) -> decltype(take()) {
    const Instant giveUp = monotonicNow() + seconds(10);
    while (monotonicNow() < giveUp) {
        if (auto item = take()) return item;
        end.wait(milliseconds(20));
    }
    return {};
}

// What the master hears when the node says this until it is heard: the connection takes its time.
std::optional<FromPeer> heardFrom(NodeChannels& node, MasterChannels& master, ByteView words) {
    return await(master, [&] {
        auto heard = master.receiveControl();
        if (!heard) node.sendControl(words);
        return heard;
    });
}

class BothChannels : public testing::TestWithParam<Pair (*)()> {};
INSTANTIATE_TEST_SUITE_P(Channels, BothChannels, testing::Values(overSockets, inMemory));

TEST_P(BothChannels, theMasterAnswersTheNodeThatSpoke) {
    auto [master, node] = GetParam()();
    const auto heard = heardFrom(*node, *master, bytes("hello"));
    ASSERT_TRUE(heard);
    EXPECT_EQ(text(heard->bytes), "hello");
    master->sendControl(heard->peer, bytes("welcome"));
    const auto answer = await(*node, [&] { return node->receiveControl(); });
    ASSERT_TRUE(answer);
    EXPECT_EQ(text(*answer), "welcome");
}

TEST_P(BothChannels, statesReachASubscriberInOrder) {
    auto [master, node] = GetParam()();
    node->subscribeState(master->stateAddress());
    // The first to arrive is a beacon: before it the subscription is still on its way.
    const auto first = await(*node, [&] {
        master->publishState(bytes("0"));
        return node->receiveState();
    });
    ASSERT_TRUE(first);
    for (int state = 1; state <= 5; ++state) master->publishState(bytes(std::to_string(state)));
    std::vector<std::string> states;
    while (states.empty() || states.back() != "5") {
        const auto state = await(*node, [&] { return node->receiveState(); });
        ASSERT_TRUE(state);
        if (text(*state) != "0") states.push_back(text(*state));
    }
    EXPECT_THAT(states, testing::ElementsAre("1", "2", "3", "4", "5"));
}

TEST_P(BothChannels, aReplyToNobodyIsHarmless) {
    auto [master, node] = GetParam()();
    master->sendControl("nobody", bytes("x"));
    master->sendControl("", bytes("x"));
    EXPECT_TRUE(heardFrom(*node, *master, bytes("still here")));
}

TEST_P(BothChannels, anotherThreadEndsTheWait) {
    auto [master, node] = GetParam()();
    std::thread other([&, &m = *master, &n = *node] {
        m.wake();
        n.wake();
    });
    master->wait(seconds(3600));  // the suite's budget would stop it
    node->wait(seconds(3600));
    other.join();
}

TEST(MemoryChannels, loseAsManyStatesAsAsked) {
    test::MemoryNet net({Instant{0}, 16, 7});
    const auto master = net.master();
    const auto node = net.node();
    node->subscribeState("");
    int arrived = 0;
    for (int state = 0; state < 6400; ++state) {
        master->publishState(bytes("s"));
        if (node->receiveState()) ++arrived;
    }
    EXPECT_NEAR(arrived, 4800, 150);
}

std::string bindError(const std::string& control, const std::string& state) {
    try {
        static_cast<void>(bindMaster(control, state));
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(ZmqChannels, anOccupiedPortIsNamedWithTheRemedy) {
    const auto first = bindMaster("tcp://127.0.0.1:*", "tcp://127.0.0.1:*");
    const auto message = bindError(first->controlAddress(), "tcp://127.0.0.1:*");
    EXPECT_THAT(message, testing::HasSubstr(first->controlAddress()));
    EXPECT_THAT(message, testing::HasSubstr("stop the other master"));
}

TEST(ZmqChannels, neitherAddressMayReachPastTheLoopback) {
    EXPECT_THAT(bindError("tcp://0.0.0.0:0", "tcp://127.0.0.1:*"), testing::HasSubstr("port"));
    EXPECT_THAT(bindError("tcp://0.0.0.0:*", "tcp://127.0.0.1:*"), testing::HasSubstr("keys"));
    EXPECT_THAT(bindError("tcp://127.0.0.1:*", "tcp://*:7401"), testing::HasSubstr("host"));
}

TEST(ZmqChannels, aNodeRefusesANonsenseAddress) {
    EXPECT_THROW(static_cast<void>(connectNode("nonsense")), Error);
}

// A node that never reads: the master's memory stays a few states, its time is not taken.
TEST(ZmqChannels, aStalledSubscriberDoesNotHoldTheOthersUp) {
    auto [master, stalled] = overSockets();
    const auto quick = connectNode(master->controlAddress());
    const ByteVector state(100'000);
    for (const auto& node : {stalled.get(), quick.get()}) {
        node->subscribeState(master->stateAddress());
        ASSERT_TRUE(await(*node, [&] {
            master->publishState(bytes("beacon"));
            return node->receiveState();
        }));
    }
    int seen = 0;
    for (int i = 0; i < 2000; ++i) {  // 200 MB, where a few states are kept
        master->publishState(state);
        while (quick->receiveState()) ++seen;
    }
    const auto another = [&] {
        master->publishState(state);
        return quick->receiveState();
    };
    while (seen < 10 && await(*quick, another))
        ++seen;  // however few of the flood it was in time for
    EXPECT_GE(seen, 10);
}

// A stranger that speaks ZeroMQ but not our language.
class Stranger {
  public:
    Stranger(zmq::socket_type type, const std::string& address) : socket_(context_, type) {
        socket_.set(zmq::sockopt::linger, 0);
        socket_.set(zmq::sockopt::sndhwm, 4);  // its own memory is not what a test measures
        socket_.connect(address);
    }
    void send(const ByteVector& noise) {
        static_cast<void>(socket_.send(zmq::buffer(noise), zmq::send_flags::dontwait));
    }
    void sendParts(const ByteVector& noise, int parts) {
        for (int part = 1; part < parts; ++part) {
            static_cast<void>(socket_.send(zmq::buffer(noise),
                                           zmq::send_flags::dontwait | zmq::send_flags::sndmore));
        }
        send(noise);
    }

  private:
    zmq::context_t context_{1};
    zmq::socket_t socket_;
};

TEST(ZmqChannels, aStrangersNoiseOnTheStatePortIsCountedAndChangesNothing) {
    auto [master, node] = overSockets();
    Stranger stranger(zmq::socket_type::xsub, master->stateAddress());
    std::mt19937 random(3);
    std::size_t noise = 0;
    const Instant giveUp = monotonicNow() + seconds(10);
    while (noise < 500 && monotonicNow() < giveUp) {
        ByteVector packet(2 + random() % 100);
        for (std::byte& byte : packet) byte = static_cast<std::byte>(random());
        packet[0] = static_cast<std::byte>(random() % 3);  // topics to subscribe, to leave, neither
        stranger.send(packet);
        noise += master->discardNoise();
    }
    EXPECT_GE(noise, 500U);
    node->subscribeState(master->stateAddress());
    EXPECT_TRUE(await(*node, [&] {
        master->publishState(bytes("beacon"));
        return node->receiveState();
    }));
}

// Resident memory of this process.
std::size_t residentBytes() {
    std::ifstream statm("/proc/self/statm");
    std::size_t all = 0;
    std::size_t resident = 0;
    statm >> all >> resident;
    return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

// Floods both ports with what they do not want, until it is killed.
[[noreturn]] void flood(const std::string& control, const std::string& state) {
    Stranger packets(zmq::socket_type::dealer, control);
    Stranger topics(zmq::socket_type::xsub, state);
    ByteVector topic(200, std::byte{1});
    for (std::uint32_t packet = 0;; ++packet) {
        packets.send(ByteVector(60'000));
        std::memcpy(topic.data() + 1, &packet, sizeof packet);  // each another
        topics.send(topic);
    }
}

// That nobody listens at: taken and given back.
std::pair<std::string, std::string> freeAddresses() {
    const auto taken = bindMaster("tcp://127.0.0.1:*", "tcp://127.0.0.1:*");
    return {taken->controlAddress(), taken->stateAddress()};
}

TEST(ZmqChannels, aStrangersFloodDoesNotFillTheMastersMemory) {
    const auto [control, state] = freeAddresses();
    const pid_t stranger = fork();  // a process of its own: its memory is not what we measure
    if (stranger == 0) flood(control, state);
    auto master = bindMaster(control, state);
    const auto node = connectNode(control);
    const std::size_t before = residentBytes();
    std::size_t noise = 0;
    const Instant giveUp = monotonicNow() + seconds(10);
    while (noise < 3000 && monotonicNow() < giveUp) {
        master->wait(milliseconds(1));
        noise += master->discardNoise();
    }
    const std::size_t after = residentBytes();
    EXPECT_GE(noise, 3000U);
    EXPECT_LT(after, before + (std::size_t{128} << 20U));
    EXPECT_TRUE(await(*master, [&] {
        node->sendControl(bytes("still here"));
        auto heard = master->receiveControl();
        return heard && heard->bytes.size() < 100 ? heard : std::nullopt;
    }));
    kill(stranger, SIGKILL);
    waitpid(stranger, nullptr, 0);
}

TEST(ZmqChannels, messagesOfSeveralPartsArriveAsNothing) {
    auto [master, node] = overSockets();
    Stranger stranger(zmq::socket_type::dealer, master->controlAddress());
    stranger.sendParts(bytes("part"), 3);
    const auto heard = await(*master, [&] { return master->receiveControl(); });
    ASSERT_TRUE(heard);
    EXPECT_TRUE(heard->bytes.empty());
    EXPECT_FALSE(master->receiveControl());
}

TEST(ZmqChannels, aPacketThatIsTooLargeNeverArrives) {
    auto master = bindMaster("tcp://127.0.0.1:*", "tcp://127.0.0.1:*", {1000, 1000});
    Stranger stranger(zmq::socket_type::dealer, master->controlAddress());
    stranger.send(ByteVector(1001));
    const auto node = connectNode(master->controlAddress());
    const auto heard = heardFrom(*node, *master, ByteVector(1000));
    ASSERT_TRUE(heard);
    EXPECT_EQ(heard->bytes.size(), 1000U);
}

}  // namespace
}  // namespace aquarama::net
