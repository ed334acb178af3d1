// SPDX-License-Identifier: Apache-2.0
// Whole shows over real sockets: order, faults, start orders.
#include <array>
#include <atomic>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <future>
#include <map>
#include <random>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "common/ask/request_client.h"
#include "master/conductor/status_text.h"
#include "tests/master/conductor/whole_show.h"

namespace aquarama::conductor {
namespace {

using std::chrono::milliseconds;

ConductorOptions lockstep(std::uint64_t frames) {
    ConductorOptions options;
    options.pace = wire::Pace::Lockstep;
    options.frames = frames;
    return options;
}

// No node presents a frame before all three were ready for it, and the one before was presented.
void expectLockstep(const std::vector<test::Event>& events, std::uint64_t frames) {
    std::map<std::string, std::uint64_t> ready, presented;
    for (const test::Event& event : events) {
        const std::uint64_t frame = event.state.frame.value;
        if (event.kind == test::Event::Kind::Ready) {
            EXPECT_EQ(frame, ready[event.node]++) << event.node << " skipped a frame";
            continue;
        }
        EXPECT_EQ(frame, presented[event.node]++) << event.node;
        for (const std::string& name : kNames) {
            EXPECT_GT(ready[name], frame) << event.node << " did not wait for " << name;
        }
    }
    for (const std::string& name : kNames) EXPECT_EQ(presented[name], frames) << name;
}

TEST(Show, inLockstepNobodyPresentsBeforeAllAreReady) {
    test::StageMaster master(lockstep(60));
    test::Journal journal;
    const auto nodes = nodesOf(master, journal);
    const ShowReport report = master.report();
    EXPECT_EQ(master.failure(), "");
    EXPECT_EQ(report.frames, 60U);
    EXPECT_EQ(report.tick, Tick{59});
    EXPECT_EQ(report.worldHash, test::CountingWorld::hashAt({59}));
    for (const std::string& name : kNames) ASSERT_TRUE(journal.awaitPresented(name, 60));
    expectLockstep(journal.events(), 60);
}

TEST(Show, inLockstepFrameNShowsTickNOnEveryNode) {
    test::StageMaster master(lockstep(20));
    test::Journal journal;
    const auto nodes = nodesOf(master, journal);
    master.report();
    for (const test::Event& event : journal.events()) {
        EXPECT_EQ(event.state.tick.value, event.state.frame.value);
        EXPECT_EQ(event.state.fraction, 1.0F);
        EXPECT_TRUE(event.state.before.empty());
        ASSERT_EQ(event.state.after.size(), 3U);
        EXPECT_EQ(event.state.after[2].x, static_cast<int>(event.state.tick.value));
        EXPECT_EQ(event.state.worldHash, test::CountingWorld::hashAt(event.state.tick));
    }
}

TEST(Show, liveFramesAdvanceTogetherAndShowOneMomentOnEveryNode) {
    ConductorOptions options;
    options.frames = 40;
    test::StageMaster master(options);
    test::Journal journal;
    const auto nodes = nodesOf(master, journal);
    EXPECT_EQ(master.report().frames, 40U);
    std::map<std::uint64_t, std::pair<std::uint64_t, float>> moments;
    double last = -1;
    for (const test::Event& event : journal.events()) {
        const auto& s = event.state;
        const auto moment = std::pair{s.tick.value, s.fraction};
        EXPECT_EQ(moments.emplace(s.frame.value, moment).first->second, moment);
        EXPECT_EQ(s.before.empty(), s.fraction == 1.0F);
    }
    for (const auto& [frame, moment] : moments) {
        const double shown = static_cast<double>(moment.first) + double{moment.second};
        EXPECT_GE(shown, last) << "frame " << frame << " goes back in time";
        last = shown;
    }
}

TEST(Show, comesUpInAnyOrder) {
    for (unsigned seed = 1; seed <= 50; ++seed) {
        std::mt19937 random(seed);
        const auto upTo = [&](unsigned ms) { return milliseconds(random() % ms); };
        // The master may come last: its address must be known, so its port is taken and given back.
        const std::string control =
            net::bindMaster("tcp://127.0.0.1:*", "tcp://127.0.0.1:*")->controlAddress();
        test::Journal journal;
        std::vector<std::unique_ptr<test::StageNode>> nodes;
        auto names = kNames;
        std::ranges::shuffle(names, random);
        std::unique_ptr<test::StageMaster> master;
        const std::size_t masterAt = random() % 4;
        for (std::size_t place = 0; place < 4; ++place) {
            if (place == masterAt)
                master = std::make_unique<test::StageMaster>(lockstep(3), control);
            if (place == 3) break;
            nodes.push_back(std::make_unique<test::StageNode>(
                names[place],
                [control] { return net::connectNode(control); },
                journal,
                test::StageNode::Habits{{}, upTo(60), upTo(30)}));
            std::this_thread::sleep_for(upTo(20));
        }
        ASSERT_EQ(master->report().frames, 3U) << "seed " << seed;
        for (const std::string& name : kNames) ASSERT_TRUE(journal.awaitPresented(name, 3));
        expectLockstep(journal.events(), 3);
    }
}

TEST(Show, liveGoesOnWithoutAFrozenNodeWhichComesBackInStep) {
    test::StageMaster master(ConductorOptions{});
    test::Journal journal;
    const auto nodes = nodesOf(master, journal, {milliseconds(2), {}, {}});
    ASSERT_TRUE(journal.awaitPresented("middle", 5));
    nodes[1]->freeze();
    const auto others = journal.presentedBy("left");
    ASSERT_TRUE(journal.awaitPresented("left", others + 60));  // for longer than its membership
    const auto frozenAt = journal.presentedBy("middle");
    nodes[1]->thaw();
    ASSERT_TRUE(journal.awaitPresented("middle", frozenAt + 20));
    EXPECT_GE(nodes[1]->joins(), 2);
    EXPECT_EQ(nodes[0]->joins(), 1);
    // Back in step: its last frames are those that the others showed with it.
    std::map<std::string, std::set<std::uint64_t>> frames;
    std::uint64_t lastOfMiddle = 0;
    for (const test::Event& event : journal.events()) {
        if (event.kind != test::Event::Kind::Presented) continue;
        frames[event.node].insert(event.state.frame.value);
        if (event.node == "middle") lastOfMiddle = event.state.frame.value;
    }
    std::size_t shared = 0;
    for (std::uint64_t frame = lastOfMiddle - 10; frame < lastOfMiddle; ++frame) {
        shared += frames["middle"].contains(frame) && frames["left"].contains(frame);
    }
    EXPECT_GE(shared, 5U);
}

TEST(Show, liveGoesOnWithoutADeadNodeWhoseSuccessorTakesItsPlace) {
    test::StageMaster master(ConductorOptions{});
    test::Journal journal;
    auto nodes = nodesOf(master, journal);
    ASSERT_TRUE(journal.awaitPresented("right", 5));
    nodes[2]->freeze();  // so that no farewell is heard
    nodes[2].reset();
    const auto diedAt = journal.presentedBy("right");
    nodes[2] = std::make_unique<test::StageNode>("right", master.connect(), journal);
    ASSERT_TRUE(journal.awaitPresented("right", diedAt + 10));
    EXPECT_EQ(nodes[0]->joins(), 1);
}

TEST(Show, lockstepWaitsForANodeThatStartsAgainAndSkipsNothing) {
    test::StageMaster master(lockstep(400));
    test::Journal journal;
    auto nodes = nodesOf(master, journal, {milliseconds(1), {}, {}});
    ASSERT_TRUE(journal.awaitPresented("left", 10));
    nodes[0]->freeze();
    nodes[0].reset();
    nodes[0] = std::make_unique<test::StageNode>("left", master.connect(), journal);
    EXPECT_EQ(master.report().frames, 400U);
    ASSERT_TRUE(journal.awaitPresented("middle", 400));
    std::map<std::string, std::uint64_t> presented;
    for (const test::Event& event : journal.events()) {
        if (event.kind != test::Event::Kind::Presented || event.node == "left") continue;
        EXPECT_EQ(event.state.frame.value, presented[event.node]++);
    }
}

TEST(Show, lockstepEndsByNameWhenANodeStaysSilent) {
    ConductorOptions options = lockstep(100000);
    options.patience = std::chrono::seconds(2);
    test::StageMaster master(options);
    test::Journal journal;
    const auto nodes = nodesOf(master, journal);
    ASSERT_TRUE(journal.awaitPresented("left", 3));
    nodes[1]->freeze();
    master.report();
    EXPECT_THAT(master.failure(), testing::HasSubstr("\"middle\""));
}

TEST(Show, nodesFindAMasterThatWasStartedAgain) {
    auto first = std::make_unique<test::StageMaster>(ConductorOptions{});
    const std::string control = first->control();
    test::Journal journal;
    const auto nodes = nodesOf(*first, journal);
    ASSERT_TRUE(journal.awaitPresented("left", 5));
    // A master that dies says no farewell. Here it is stopped, and says one: so the nodes' cables
    // are cut while it does.
    for (const auto& node : nodes) node->freeze();
    first.reset();
    test::StageMaster second(ConductorOptions{}, control);
    for (const auto& node : nodes) node->thaw();
    for (const std::string& name : kNames) {
        ASSERT_TRUE(journal.awaitPresented(name, journal.presentedBy(name) + 5)) << name;
    }
    EXPECT_GE(nodes[0]->joins(), 2);
}

std::size_t residentMebibytes() {
    std::ifstream file("/proc/self/statm");
    std::size_t total = 0, resident = 0;
    file >> total >> resident;
    return resident * static_cast<std::size_t>(sysconf(_SC_PAGESIZE)) >> 20U;
}

// A node that counts its frames and keeps nothing. True where it saw each of them, once and in
// order.
bool seesAllFrames(session::Session& session,
                   std::uint64_t frames,
                   std::atomic<std::uint64_t>& seen) {
    std::uint64_t next = 0;
    while (const auto admission = session.join()) {
        session.prepared(1, config::QualityTier::Low, test::stillMotion(*admission));
        while (const auto state = session.nextFrame()) {
            if (state->frame.value != next || state->tick.value != next) return false;
            if (session.readyThenWait(state->frame) == session::Release::Present) seen = ++next;
        }
        if (session.interruption() == session::Release::Quit) break;
    }
    return next == frames;
}

// The traffic of a session without sockets, in lockstep, as fast as it goes: of two minutes, in a
// soak of 24 hours.
TEST(Show, aDayOfFramesKeepsItsMemoryAndItsCounts) {
    const bool isSoak = std::getenv("AQUARAMA_SOAK") != nullptr;
    const std::uint64_t frames = 60U * 60U * (isSoak ? 24U * 60U : 2U);
    test::MemoryNet net;
    test::StageMaster master(lockstep(frames), net.master());
    const auto blobs = test::freshDirectory();
    std::vector<std::future<bool>> nodes;
    std::atomic<std::uint64_t> seen = 0;
    for (const std::string& name : kNames)
        nodes.push_back(std::async(std::launch::async, [&net, &blobs, &seen, name, frames] {
            const auto session = session::makeSession(
                name, [&net] { return net.node(); }, blobs);
            return seesAllFrames(*session, frames, seen);
        }));
    // Everybody has come, and every buffer has its size.
    while (seen < frames / 2 && seen < 60U * 60U)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    [[maybe_unused]] const std::size_t before = residentMebibytes();
    const ShowReport report = master.report();
    for (std::future<bool>& node : nodes) EXPECT_TRUE(node.get());
#ifndef __SANITIZE_ADDRESS__  // which keeps what was freed, to find who still uses it
    EXPECT_LT(residentMebibytes(), before + 16);
#endif
    EXPECT_EQ(report.frames, frames);
    EXPECT_EQ(report.tick.value, frames - 1);
    EXPECT_EQ(report.refusedPackets, 0U);
    std::filesystem::remove_all(blobs);
}

// A show with keys over the loopback: those of the nodes, of a visitor and of a watcher.
class KeyedShow : public testing::Test {
  protected:
    static net::Allowed allowedOf(const std::map<std::string, net::KeyPair>& keys) {
        net::Allowed allowed;
        for (const auto& [user, pair] : keys) allowed.emplace(pair.publicKey, user);
        return allowed;
    }
    net::Connect connect(const std::string& user) {
        return [this, own = keys_.at(user)] {
            return net::connectNode(
                master_.control(), {}, net::PeerKeys{masterKeys_.publicKey, own});
        };
    }

    const net::KeyPair masterKeys_ = net::makeKeyPair();
    const std::map<std::string, net::KeyPair> keys_{{"node left", net::makeKeyPair()},
                                                    {"node middle", net::makeKeyPair()},
                                                    {"node right", net::makeKeyPair()},
                                                    {"visitor phone", net::makeKeyPair()},
                                                    {"watcher board", net::makeKeyPair()}};
    test::StageMaster master_{
        ConductorOptions{},
        net::bindMaster("tcp://127.0.0.1:*",
                        "tcp://127.0.0.1:*",
                        {},
                        net::MasterKeys{masterKeys_, [this] { return allowedOf(keys_); }})};
};

// Says again and again, with its own key, what another has said, and answers that are none of its.
void flood(net::NodeChannels& channels,
           const std::vector<net::ByteVector>& packets,
           const std::atomic<bool>& ended) {
    while (!ended) {
        for (const net::ByteVector& packet : packets) channels.sendControl(packet);
        while (channels.receiveControl()) {
        }
        std::this_thread::sleep_for(milliseconds(5));  // 100 000 packets a second are enough
    }
}

// What a node has said, overheard from its own end of the cable.
class Overheard final : public net::NodeChannels {
  public:
    Overheard(std::unique_ptr<net::NodeChannels> inner,
              std::mutex& mutex,
              std::vector<net::ByteVector>& said)
        : inner_(std::move(inner)), mutex_(mutex), said_(said) {}
    void sendControl(net::ByteView bytes) override {
        inner_->sendControl(bytes);
        const std::lock_guard lock(mutex_);
        if (said_.size() < 500) said_.emplace_back(bytes.begin(), bytes.end());
    }
    std::optional<net::ByteVector> receiveControl() override { return inner_->receiveControl(); }
    void subscribeState(const std::string& address) override { inner_->subscribeState(address); }
    std::optional<net::ByteVector> receiveState() override { return inner_->receiveState(); }
    void wait(net::Duration atMost) override { inner_->wait(atMost); }
    void wake() override { inner_->wake(); }

  private:
    std::unique_ptr<net::NodeChannels> inner_;
    std::mutex& mutex_;
    std::vector<net::ByteVector>& said_;
};

TEST_F(KeyedShow, floodsAndReplaysByHoldersOfKeysEndNothing) {
    test::Journal journal;
    std::mutex mutex;
    std::vector<net::ByteVector> said;
    const auto overheard = [&, inner = connect("node left")] {
        return std::make_unique<Overheard>(inner(), mutex, said);
    };
    test::StageNode left("left", overheard, journal);
    test::StageNode middle("middle", connect("node middle"), journal);
    test::StageNode right("right", connect("node right"), journal);
    for (const std::string& name : kNames) ASSERT_TRUE(journal.awaitPresented(name, 30)) << name;

    std::vector<net::ByteVector> replayed;
    {
        const std::lock_guard lock(mutex);
        replayed = said;
    }
    // Farewells and hellos of another, settings, questions, noise.
    for (const v1::Envelope& message :
         {test::farewell(), test::hello("left"), test::hello("nobody"), test::statusRequest()})
        replayed.push_back(wire::encode(1, message));
    replayed.emplace_back(60000, std::byte{0xA5});
    std::atomic<bool> ended = false;
    std::vector<std::thread> floods;
    for (const char* user : {"visitor phone", "watcher board"})
        floods.emplace_back([&, channels = std::shared_ptr(connect(user)())] {
            flood(*channels, replayed, ended);
        });
    // Each frame has its own time: what counts is that frames go on, not how fast.
    for (const std::string& name : kNames)
        for (std::uint64_t last = journal.presentedBy(name) + 60, frame = last - 59; frame <= last;
             ++frame)
            EXPECT_TRUE(journal.awaitPresented(name, frame)) << name << " frame " << frame;
    ended = true;
    for (std::thread& thread : floods) thread.join();
    for (const test::StageNode* node : {&left, &middle, &right}) EXPECT_EQ(node->joins(), 1);
    master_.conductor().stop();
    EXPECT_GT(master_.report().refusedPackets, 1000U);
}

TEST(Show, anyNodeMayEndIt) {
    test::StageMaster master(ConductorOptions{});
    test::Journal journal;
    const auto nodes = nodesOf(master, journal);
    ASSERT_TRUE(journal.awaitPresented("middle", 3));
    nodes[1]->session().quit();
    EXPECT_GE(master.report().frames, 3U);
}

TEST(Show, anEvenlySlowWallLosesNobody) {
    config::Rig rig = test::StageMaster::deskRig();
    rig.timing.presentDeadlineSeconds = 1.0 / 60;  // far less than a frame takes
    ConductorOptions options;
    options.frames = 12;
    test::StageMaster master(options, "tcp://127.0.0.1:*", rig);
    test::Journal journal;
    const auto nodes = nodesOf(master, journal, {milliseconds(80), {}, {}});
    EXPECT_EQ(master.report().frames, 12U);
    for (const auto& node : nodes) EXPECT_EQ(node->joins(), 1);
}

TEST(Show, lostStatesAreSentAgain) {
    test::MemoryNet net({milliseconds(1), 16, 3});  // one in four
    test::StageMaster master(lockstep(4), net.master());
    test::Journal journal;
    std::vector<std::unique_ptr<test::StageNode>> nodes;
    for (const std::string& name : kNames) {
        nodes.push_back(std::make_unique<test::StageNode>(
            name, [&net] { return net.node(); }, journal));
    }
    EXPECT_EQ(master.report().frames, 4U);
    for (const std::string& name : kNames) ASSERT_TRUE(journal.awaitPresented(name, 4));
    expectLockstep(journal.events(), 4);
}

TEST(Show, itsStatusNamesEveryNodeAndTheJournal) {
    ConductorOptions options;
    options.journal = std::make_shared<JournalReport>(v1::JournalStatus::REFUSED, "no folder");
    test::StageMaster master(options);
    test::Journal journal;
    const test::StageNode left("left", master.connect(), journal);
    ASSERT_TRUE(journal.awaitPresented("left", 30));
    const std::string text = statusText(ask::RequestClient(master.control()).status());
    EXPECT_THAT(text, testing::HasSubstr("live"));
    EXPECT_THAT(text, testing::ContainsRegex("left +in step"));
    EXPECT_THAT(text, testing::ContainsRegex("right +absent"));
    EXPECT_THAT(text, testing::ContainsRegex("journal +none: no folder"));
}

}  // namespace
}  // namespace aquarama::conductor
