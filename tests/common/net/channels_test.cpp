// SPDX-License-Identifier: Apache-2.0
// The same promises for both kinds of channels, and over real sockets what strangers may do.
#include "common/net/channels.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <mutex>
#include <random>
#include <thread>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <zmq.hpp>

#include "common/base/log.h"
#include "tests/support/await.h"
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
    const Moment giveUp = monotonicNow() + seconds(10);
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
    const Pair pair = GetParam()();
    const auto& master = pair.master;
    const auto& node = pair.node;
    const auto heard = heardFrom(*node, *master, bytes("hello"));
    ASSERT_TRUE(heard);
    EXPECT_EQ(text(heard->bytes), "hello");
    master->sendControl(heard->peer, bytes("welcome"));
    const auto answer = await(*node, [&] { return node->receiveControl(); });
    ASSERT_TRUE(answer);
    EXPECT_EQ(text(*answer), "welcome");
}

TEST_P(BothChannels, statesReachASubscriberInOrder) {
    const Pair pair = GetParam()();
    const auto& master = pair.master;
    const auto& node = pair.node;
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
    const Pair pair = GetParam()();
    const auto& master = pair.master;
    const auto& node = pair.node;
    master->sendControl("nobody", bytes("x"));
    master->sendControl("", bytes("x"));
    EXPECT_TRUE(heardFrom(*node, *master, bytes("still here")));
}

TEST_P(BothChannels, anotherThreadEndsTheWait) {
    const auto pair = std::make_shared<Pair>(GetParam()());
    std::thread other([pair] {
        pair->master->wake();
        pair->node->wake();
    });
    EXPECT_TRUE(test::ends([pair] { pair->master->wait(seconds(3600)); }));
    EXPECT_TRUE(test::ends([pair] { pair->node->wait(seconds(3600)); }));
    other.join();
}

TEST(MemoryChannels, loseAsManyStatesAsAsked) {
    test::MemoryNet net({Duration{0}, 16, 7});
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

// A master with keys, and the list that says who may connect.
class Keyed : public testing::Test {
  protected:
    [[nodiscard]] std::unique_ptr<NodeChannels> nodeWith(const KeyPair& own) const {
        return connectNode(master_->controlAddress(), {}, PeerKeys{keys_.publicKey, own});
    }
    void allow(const Allowed& allowed) {
        const std::lock_guard lock(mutex_);
        allowed_ = allowed;
    }
    // Whether the master hears a node within so long.
    bool hears(NodeChannels& node, Duration within = milliseconds(500)) {
        const Moment giveUp = monotonicNow() + within;
        while (monotonicNow() < giveUp) {
            node.sendControl(bytes("hello"));
            master_->wait(milliseconds(10));
            if (const auto heard = master_->receiveControl()) {
                user_ = heard->user;
                return text(heard->bytes) == "hello";
            }
        }
        return false;
    }

    const KeyPair keys_ = makeKeyPair(), left_ = makeKeyPair(), right_ = makeKeyPair();
    std::mutex mutex_;
    Allowed allowed_{{left_.publicKey, "node left"}, {right_.publicKey, "node right"}};
    std::unique_ptr<MasterChannels> master_ = bindMaster(
        "tcp://127.0.0.1:*", "tcp://127.0.0.1:*", {}, MasterKeys{keys_, [this] {
                                                                     const std::lock_guard lock(
                                                                         mutex_);
                                                                     return allowed_;
                                                                 }});
    std::string user_;
};

TEST_F(Keyed, whoShowsAKeyIsHeardByItsName) {
    const auto left = nodeWith(left_);
    const auto right = nodeWith(right_);
    ASSERT_TRUE(hears(*left, seconds(10)));
    EXPECT_EQ(user_, "node left");
    ASSERT_TRUE(hears(*right, seconds(10)));
    EXPECT_EQ(user_, "node right");
    left->subscribeState(master_->stateAddress());
    EXPECT_TRUE(await(*left, [&] {
        master_->publishState(bytes("state"));
        return left->receiveState();
    }));
}

TEST_F(Keyed, noKeyAnUnknownKeyAndAnotherMastersAreNotHeard) {
    const auto none = connectNode(master_->controlAddress());
    const auto unknown = nodeWith(makeKeyPair());
    const auto fooled =
        connectNode(master_->controlAddress(), {}, PeerKeys{makeKeyPair().publicKey, left_});
    EXPECT_FALSE(hears(*none));
    EXPECT_FALSE(hears(*unknown));
    EXPECT_FALSE(hears(*fooled)) << "it thinks the master somebody else";
    EXPECT_TRUE(hears(*nodeWith(left_), seconds(10))) << "the others are none the worse";
}

// Of this process, in bytes.
std::size_t residentMemory() {
    std::ifstream file("/proc/self/statm");
    std::size_t total = 0, resident = 0;
    file >> total >> resident;
    return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

// A connection to an address of ZeroMQ that speaks as it likes.
class RawConnection {
  public:
    explicit RawConnection(const std::string& address) : socket_(socket(AF_INET, SOCK_STREAM, 0)) {
        sockaddr_in to{};
        to.sin_family = AF_INET;
        to.sin_port =
            htons(static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1))));
        to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        isOpen_ =
            socket_ >= 0 && connect(socket_, reinterpret_cast<sockaddr*>(&to), sizeof to) == 0;
    }
    ~RawConnection() {
        if (socket_ >= 0) close(socket_);
    }
    RawConnection(RawConnection&& other) noexcept
        : socket_(std::exchange(other.socket_, -1)), isOpen_(other.isOpen_) {}
    RawConnection& operator=(RawConnection&&) = delete;
    RawConnection(const RawConnection&) = delete;
    RawConnection& operator=(const RawConnection&) = delete;

    [[nodiscard]] bool isOpen() const { return isOpen_; }
    void say(const std::string& raw) const {
        ASSERT_EQ(send(socket_, raw.data(), raw.size(), MSG_NOSIGNAL),
                  static_cast<ssize_t>(raw.size()));
    }
    // Whether the other end hangs up within so long; what it says is thrown away.
    [[nodiscard]] bool isCutOffWithin(milliseconds within) const {
        const Moment giveUp = monotonicNow() + within;
        while (monotonicNow() < giveUp) {
            pollfd poll{socket_, POLLIN, 0};
            if (::poll(&poll, 1, 50) <= 0) continue;
            std::array<char, 4096> heard{};
            if (recv(socket_, heard.data(), heard.size(), 0) <= 0) return true;
        }
        return false;
    }

  private:
    int socket_;
    bool isOpen_ = false;
};

// ZMTP 3.0: a greeting that asks for CURVE, and a command that claims to be a gibibyte long.
TEST_F(Keyed, aLengthOfAGibibyteTakesNoMemory) {
    std::string greeting = std::string("\xff\0\0\0\0\0\0\0\1\x7f\3\0", 12) + "CURVE";
    greeting.resize(64);
    const std::size_t before = residentMemory();
    const RawConnection raw(master_->controlAddress());
    ASSERT_TRUE(raw.isOpen());
    raw.say(greeting);
    raw.say(std::string("\6\0\0\0\0\x40\0\0\0", 9));
    raw.say(std::string(1000, 'x'));
    EXPECT_TRUE(raw.isCutOffWithin(seconds(10)));
    EXPECT_LT(residentMemory(), before + (64U << 20U));
    EXPECT_TRUE(hears(*nodeWith(right_), seconds(10)));
}

// The sender has a key; its message is as long as ZeroMQ lets it.
TEST_F(Keyed, aTooLongMessageCutsOffItsSenderAlone) {
    const auto left = nodeWith(left_);
    const auto right = nodeWith(right_);
    ASSERT_TRUE(hears(*left, seconds(10)));
    ASSERT_TRUE(hears(*right, seconds(10)));
    left->sendControl(ByteVector(PacketLimits{}.toMaster + 1));
    EXPECT_TRUE(hears(*right, seconds(10)));
    const Moment end = monotonicNow() + milliseconds(300);
    while (monotonicNow() < end) {
        master_->wait(milliseconds(10));
        while (const auto heard = master_->receiveControl())
            EXPECT_LE(heard->bytes.size(), PacketLimits{}.toMaster);
    }
}

// Each costs ZeroMQ a session until its two seconds for a handshake are over. In a soak, which
// takes more than a minute, ten thousand.
TEST_F(Keyed, hundredsOfConnectionsThatSayNothingKeepNobodyOut) {
    rlimit files{};
    getrlimit(RLIMIT_NOFILE, &files);
    files.rlim_cur = files.rlim_max;
    setrlimit(RLIMIT_NOFILE, &files);
    const auto right = nodeWith(right_);
    ASSERT_TRUE(hears(*right, seconds(10)));
    std::vector<RawConnection> silent;
    // Both ends of each are in this process.
    const std::size_t most = std::getenv("AQUARAMA_SOAK") != nullptr ? 10000 : 500;
    const std::size_t wanted = std::min<std::size_t>(most, files.rlim_max / 2 - 200);
    for (std::size_t i = 0; i < wanted; ++i) {
        silent.emplace_back(master_->controlAddress());
        if (i % 100 == 0) {
            EXPECT_TRUE(hears(*right, seconds(10)));
        }
    }
    std::cout << "[ INFO     ] " << silent.size() << " connections\n";
    EXPECT_TRUE(hears(*right, seconds(10)));
    EXPECT_TRUE(hears(*nodeWith(left_), seconds(10))) << "who comes now";
    EXPECT_TRUE(silent.front().isCutOffWithin(seconds(10)));
}

// A hundred within ten seconds of the first: where a slow machine takes longer for all of them, the
// next is heard after that.
TEST_F(Keyed, whoConnectsWithOneKeyAgainAndAgainIsRefusedForAWhileAndTheOthersAreNot) {
    using Clock = std::chrono::steady_clock;
    const auto right = nodeWith(right_);
    ASSERT_TRUE(hears(*right, seconds(10)));
    std::vector<Clock::time_point> begun, ended;
    for (int connection = 0; connection < 130; ++connection) {
        const auto begin = Clock::now();
        if (!hears(*nodeWith(left_), milliseconds(connection < 100 ? 5000 : 100))) continue;
        begun.push_back(begin);
        ended.push_back(Clock::now());
    }
    EXPECT_GE(begun.size(), 50U);
    if (ended.size() > 100) {
        EXPECT_GE(ended[100] - begun[0], seconds(10));
    }
    EXPECT_TRUE(hears(*right, seconds(10)));
    EXPECT_EQ(user_, "node right");
}

// Within two seconds; the other comes back over a connection of its own accord.
TEST_F(Keyed, aRevokedKeyIsCutOffAndTheOthersAreNot) {
    const auto left = nodeWith(left_);
    const auto right = nodeWith(right_);
    ASSERT_TRUE(hears(*left, seconds(10)));
    ASSERT_TRUE(hears(*right, seconds(10)));
    const auto stateOf = [&](NodeChannels& node) {
        node.subscribeState(master_->stateAddress());
        return await(node, [&] {
            master_->publishState(bytes("state"));
            return node.receiveState();
        });
    };
    EXPECT_TRUE(stateOf(*left));
    allow({{right_.publicKey, "node right"}});
    const Moment giveUp = monotonicNow() + seconds(6);
    bool heardLeft = true;
    while (heardLeft && monotonicNow() < giveUp) {
        while (master_->receiveControl()) {
        }
        heardLeft = hears(*left, milliseconds(300));
    }
    EXPECT_FALSE(heardLeft);
    while (left->receiveState()) {
    }
    for (int state = 0; state < 20; ++state) {
        master_->publishState(bytes("secret"));
        left->wait(milliseconds(10));
        EXPECT_FALSE(left->receiveState());
    }
    ASSERT_TRUE(hears(*right, seconds(10)));
    EXPECT_EQ(user_, "node right");
}

TEST_F(Keyed, aKeyThatIsNoneIsRefused) {
    EXPECT_THROW(static_cast<void>(nodeWith({"short", "keys"})), Error);
    EXPECT_THROW(
        static_cast<void>(bindMaster("tcp://127.0.0.1:*",
                                     "tcp://127.0.0.1:*",
                                     {},
                                     MasterKeys{{"short", "keys"}, [] { return Allowed{}; }})),
        Error);
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
    const Pair pair = overSockets();
    const auto& master = pair.master;
    const auto& stalled = pair.node;
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
    const Pair pair = overSockets();
    const auto& master = pair.master;
    const auto& node = pair.node;
    Stranger stranger(zmq::socket_type::xsub, master->stateAddress());
    std::mt19937 random(3);
    std::size_t noise = 0;
    const Moment giveUp = monotonicNow() + seconds(10);
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
    const Moment giveUp = monotonicNow() + seconds(10);
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
    const Pair pair = overSockets();
    const auto& master = pair.master;
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

void requireBindAddress(const std::string& address) {
    EXPECT_NE(bindAddress(address), "");
}

std::string refusal(void (*check)(const std::string&), const std::string& address) {
    try {
        check(address);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

TEST(Address, theLoopbackMayBeBound) {
    for (const char* address :
         {"tcp://127.0.0.1:7400", "tcp://127.8.9.1:1", "tcp://[::1]:65535", "tcp://127.0.0.1:*"}) {
        EXPECT_EQ(refusal(requireBindAddress, address), "") << address;
    }
}

TEST(Address, localhostIsThisMachineWhateverItsResolverThinks) {
    EXPECT_EQ(bindAddress("tcp://localhost:7400"), "tcp://127.0.0.1:7400");
}

TEST(Address, nothingPastTheLoopbackMayBeBoundWithoutKeys) {
    for (const char* address : {"tcp://0.0.0.0:7400",
                                "tcp://*:7400",
                                "tcp://192.168.1.4:7400",
                                "tcp://[::]:7400",
                                "tcp://[fe80::1]:7400",
                                "tcp://128.0.0.1:7400",
                                "tcp://eth0:7400"}) {
        EXPECT_NE(refusal(requireBindAddress, address), "") << address;
    }
    EXPECT_THAT(refusal(requireBindAddress, "tcp://10.0.0.1:7400"),
                testing::HasSubstr("without keys"));
}

TEST(Address, whatIsMalformedIsNamed) {
    for (const char* address : {"",
                                "7400",
                                "127.0.0.1:7400",
                                "udp://127.0.0.1:7400",
                                "tcp://",
                                "tcp://:7400",
                                "tcp://127.0.0.1",
                                "tcp://127.0.0.1:",
                                "tcp://127.0.0.1:0",
                                "tcp://127.0.0.1:65536",
                                "tcp://127.0.0.1:74x",
                                "tcp://127.0.0.1:-1",
                                "tcp://a b:1",
                                "tcp://[::1:7400"}) {
        EXPECT_THAT(refusal(requireConnectAddress, address), testing::HasSubstr(address));
        EXPECT_NE(refusal(requireConnectAddress, address), "") << address;
        EXPECT_NE(refusal(requireBindAddress, address), "") << address;
    }
}

TEST(Address, aNodeMayReachAnyHostButNeedsItsPort) {
    EXPECT_EQ(refusal(requireConnectAddress, "tcp://master.hall:7400"), "");
    EXPECT_NE(refusal(requireConnectAddress, "tcp://127.0.0.1:*"), "");
}

// A folder for the sockets of frames, which goes with the test.
class FrameChannel : public testing::Test {
  protected:
    FrameChannel() {
        std::string pattern =
            (std::filesystem::temp_directory_path() / "aquarama-frames-XXXXXX").string();
        path_ = frameSocket(mkdtemp(pattern.data()), "left");
    }
    ~FrameChannel() override { std::filesystem::remove_all(path_.parent_path()); }

    static RawFrame frameOf(std::uint64_t number, std::int32_t width = 640) {
        return {number, width, 2, std::vector<std::uint16_t>(std::size_t(width) * 6, number % 256)};
    }

    std::filesystem::path path_;
};

// More frames than the queues hold, from a sender that is gone before the last is received.
TEST_F(FrameChannel, everyFrameArrivesInOrderAndThenTheEnd) {
    const std::jthread node([path = path_] {
        const auto sender = connectFrames(path);
        for (std::uint64_t frame = 0; frame < 50; ++frame) sender->send(frameOf(frame));
    });
    const auto receiver = bindFrames(path_);
    for (std::uint64_t frame = 0; frame < 50; ++frame) {
        if (frame > 40) std::this_thread::sleep_for(milliseconds(20));
        const auto received = receiver->receive();
        ASSERT_TRUE(received) << frame;
        EXPECT_EQ(received->frame, frame);
        EXPECT_EQ(received->width, 640);
        EXPECT_EQ(received->height, 2);
        EXPECT_EQ(received->rgb, frameOf(frame).rgb);
    }
    EXPECT_FALSE(receiver->receive());
    EXPECT_FALSE(receiver->receive());
}

TEST_F(FrameChannel, aSenderWaitsForASlowReceiver) {
    std::atomic<int> sent = 0;
    constexpr int kFrames = 12;
    const std::jthread node([&] {
        const auto sender = connectFrames(path_);
        for (int frame = 0; frame < kFrames; ++frame) {
            sender->send(frameOf(static_cast<std::uint64_t>(frame), 1'000'000));
            ++sent;
        }
    });
    const auto receiver = bindFrames(path_);
    ASSERT_TRUE(receiver->receive());
    std::this_thread::sleep_for(milliseconds(300));
    EXPECT_LT(sent, kFrames);
    for (int frame = 1; frame < kFrames; ++frame) ASSERT_TRUE(receiver->receive());
    EXPECT_FALSE(receiver->receive());
}

// Also one that is held up at the time, because its frames fill all queues.
TEST_F(FrameChannel, aReceiverThatEndsIsAnErrorOfTheSender) {
    for (const int before : {0, 100}) {
        auto receiver = bindFrames(path_);
        const auto sender = connectFrames(path_);
        std::thread end([&] {
            std::this_thread::sleep_for(milliseconds(100));
            receiver.reset();
        });
        if (before == 0) end.join();
        EXPECT_THROW(for (std::uint64_t frame = 0; frame < 10'000; ++frame)
                         sender->send(frameOf(frame, 1'000'000)),
                     Error);
        if (end.joinable()) end.join();
    }
}

TEST_F(FrameChannel, aSenderThatIsKilledIsTheEnd) {
    const auto receiver = bindFrames(path_);
    const pid_t node = fork();
    if (node == 0) {
        const auto sender = connectFrames(path_);
        for (std::uint64_t frame = 0;; ++frame) sender->send(frameOf(frame, 1'000'000));
    }
    ASSERT_TRUE(receiver->receive());
    kill(node, SIGKILL);
    while (receiver->receive()) {
    }
    waitpid(node, nullptr, 0);
}

TEST_F(FrameChannel, whatIsNoFrameIsAnError) {
    const auto receiver = bindFrames(path_);
    zmq::context_t context;
    zmq::socket_t stranger(context, zmq::socket_type::push);
    stranger.connect("ipc://" + path_.string());
    stranger.send(zmq::str_buffer("noise"), zmq::send_flags::none);
    EXPECT_THROW(static_cast<void>(receiver->receive()), Error);
}

TEST_F(FrameChannel, aPlaceWhereNoSocketCanBeIsNamed) {
    try {
        static_cast<void>(bindFrames(path_.parent_path() / "nowhere" / "left"));
        FAIL() << "listens nowhere";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("nowhere/left"));
    }
}

}  // namespace
}  // namespace aquarama::net
