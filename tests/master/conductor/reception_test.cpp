// SPDX-License-Identifier: Apache-2.0
// The master's answers, word by word, to a peer that says whatever a test wants it to say.
#include <algorithm>
#include <fstream>
#include <random>
#include <sstream>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/net/blob.h"
#include "tests/support/stage.h"

namespace aquarama {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class Peer {
  public:
    explicit Peer(MemoryNet& net) : channels_(net.node()) { channels_->subscribeState(""); }
    ~Peer() { say(Farewell{}); }  // so that the master need not wait for it at the end
    Peer(const Peer&) = delete;
    Peer& operator=(const Peer&) = delete;

    void say(const Message& message) { channels_->sendControl(encode({session, message})); }
    void sayNoise(const ByteVector& noise) { channels_->sendControl(noise); }

    // The next message of this kind, whatever comes between; empty after five seconds.
    template <class Kind>
    std::optional<Kind> hear() {
        return awaitKind<Kind>([&] { return channels_->receiveControl(); }, seconds(5));
    }
    template <class Kind>
    bool hearsNo(Instant within) {
        return !awaitKind<Kind>([&] { return channels_->receiveControl(); }, within);
    }
    std::optional<StateFrame> seeState() {
        return awaitKind<StateFrame>([&] { return channels_->receiveState(); }, seconds(5));
    }
    // Sees the state of this frame, says ready, and gives the frame that is presented then.
    std::optional<std::uint64_t> present(std::uint64_t frame) {
        std::optional<StateFrame> state;
        do {
            state = seeState();
        } while (state && state->frame.value < frame);
        say(Ready{{frame}, {}});
        const auto present = hear<Present>();
        return present ? std::optional{present->frame.value} : std::nullopt;
    }
    // Hello, welcome, prepared: a member.
    bool join(const std::string& name, QualityTier bears = QualityTier::Low) {
        say(Hello{name, kProtocolMajor, ""});
        if (!hear<Welcome>()) return false;
        say(Prepared{bears});
        return hear<Joined>().has_value();
    }

    std::uint64_t session = 0;  // of the last message heard

  private:
    template <class Kind, class Receive>
    std::optional<Kind> awaitKind(Receive receive, Instant within) {
        const Instant end = monotonicNow() + within;
        while (monotonicNow() < end) {
            while (const auto bytes = receive()) {
                auto envelope = decode(*bytes);
                if (!envelope) continue;
                session = envelope->session;
                if (auto* kind = std::get_if<Kind>(&envelope->message)) return std::move(*kind);
            }
            channels_->wait(milliseconds(5));
        }
        return std::nullopt;
    }

    std::unique_ptr<NodeChannels> channels_;
};

class Reception : public testing::Test {
  protected:
    static ConductorOptions lockstepOf(std::vector<std::string> names) {
        ConductorOptions options;
        options.pace = Pace::Lockstep;
        options.expected = std::move(names);
        return options;
    }
    StatusReply status() {
        Peer asker(net_);
        asker.say(StatusRequest{});
        return asker.hear<StatusReply>().value_or(StatusReply{});
    }

    MemoryNet net_;
};

TEST_F(Reception, refusesAnotherMajorVersionByName) {
    const StageMaster master(ConductorOptions{}, net_.master());
    Peer peer(net_);
    peer.say(Hello{"left", kProtocolMajor + 1, "9.9.9"});
    const auto refusal = peer.hear<Refusal>();
    ASSERT_TRUE(refusal);
    EXPECT_THAT(refusal->reason, testing::HasSubstr("protocol 2"));
    EXPECT_THAT(refusal->reason, testing::HasSubstr("9.9.9"));
}

TEST_F(Reception, refusesANameThatTheRigDoesNotHaveAndSaysWhichItHas) {
    const StageMaster master(ConductorOptions{}, net_.master());
    Peer peer(net_);
    peer.say(Hello{"ceiling", kProtocolMajor, ""});
    const auto refusal = peer.hear<Refusal>();
    ASSERT_TRUE(refusal);
    EXPECT_THAT(refusal->reason, testing::HasSubstr("left, middle, right"));
}

TEST_F(Reception, welcomesWithAllThatANodeNeeds) {
    ConductorOptions options;
    options.seed = 77;
    options.pattern = Pattern::Grid;
    const StageMaster master(options, net_.master());
    Peer peer(net_);
    peer.say(Hello{"left", kProtocolMajor, ""});
    const auto welcome = peer.hear<Welcome>();
    ASSERT_TRUE(welcome);
    EXPECT_EQ(parseRig(welcome->rigText, "welcome").channels.size(), 3U);
    EXPECT_EQ(welcome->stateAddress, "memory:state");
    EXPECT_EQ(welcome->seed, 77U);
    EXPECT_EQ(welcome->pattern, Pattern::Grid);
    EXPECT_EQ(welcome->school.size(), 3U);
    BlobAssembly assembly(welcome->cast.at(0).repertoire);
    while (!assembly.whole()) {
        peer.say(BlobRequest{assembly.digest(), assembly.nextOffset()});
        const auto chunk = peer.hear<BlobChunk>();
        ASSERT_TRUE(chunk && assembly.take(chunk->offset, chunk->total, chunk->content));
    }
    EXPECT_EQ(assembly.checked(), StageMaster::repertoire());
}

// As of the status: a terminal is no node. Nobody draws, so the lockstep show stands still.
TEST_F(Reception, tellsAnybodyOfAMindAlsoWhileTheShowWaits) {
    const StageMaster master(lockstepOf({"left"}), net_.master());
    Peer asker(net_);
    asker.say(ExplainRequest{2});
    const auto explanation = asker.hear<Explanation>();
    ASSERT_TRUE(explanation);
    EXPECT_EQ(explanation->fish, 2U);
    EXPECT_EQ(explanation->school, 3U);
    EXPECT_EQ(explanation->lines,
              std::vector{"at tick " + std::to_string(explanation->tick.value)});
}

// What is dropped is in the world from one of the next ticks on; lockstep runs a few ahead.
TEST_F(Reception, aVisitorFeedsTheFishWhereTheyCanBeReachedAndNotTooOften) {
    const StageMaster master(lockstepOf({"left"}), net_.master());
    Peer left(net_);
    ASSERT_TRUE(left.join("left"));
    const auto pellets = [](const StateFrame& state) {
        return state.foodAfter.size() -
               static_cast<std::size_t>(std::ranges::count(state.foodAfter, FoodRecord{}));
    };
    const auto feed = [&](glm::vec3 place) { left.say(Input{InputKind::DropFood, place, {}}); };
    feed({0.5F, 0, -2.5F});
    for (int stuck = 0; stuck < 100; ++stuck) feed({0, 0, -2});
    std::optional<StateFrame> state;
    for (std::uint64_t frame = 0; frame < 20; ++frame) {
        state = left.seeState();
        ASSERT_TRUE(state);
        left.say(Ready{{frame}, {}});
        ASSERT_TRUE(left.hear<Present>());
    }
    EXPECT_EQ(pellets(*state), 1U);
    EXPECT_LT(glm::distance(state->foodAfter.front().offsetMetres() + state->foodOriginMetres,
                            {0.5F, 0, -2.5F}),
              1e-3F);
    const std::uint64_t refused = status().refusedPackets;
    std::this_thread::sleep_for(milliseconds(250));
    feed({0, 100, 0});
    for (std::uint64_t frame = 20; frame < 40; ++frame) {
        state = left.seeState();
        ASSERT_TRUE(state);
        left.say(Ready{{frame}, {}});
        ASSERT_TRUE(left.hear<Present>());
    }
    EXPECT_EQ(pellets(*state), 1U);
    EXPECT_EQ(status().refusedPackets, refused + 2);  // and the farewell of who asked before
}

// From a window's node as from a pilot that drives no channel; whoever has hold last.
TEST_F(Reception, handsMoveTheEye) {
    const StageMaster master(lockstepOf({"left"}), net_.master());
    Peer left(net_);
    Peer pilot(net_);
    ASSERT_TRUE(left.join("left"));
    std::uint64_t frame = 0;
    const auto eyeAfterSome = [&] {
        float ahead = 0;
        for (const std::uint64_t end = frame + 20; frame < end; ++frame) {
            const auto state = left.seeState();
            if (!state) return -1.0F;
            ahead = -state->eye.positionMetres.z;
            left.say(Ready{{frame}, {}});
            if (!left.hear<Present>()) return -1.0F;
        }
        return ahead;
    };
    left.say(Input{InputKind::Steer, {}, {.ahead = 5}});
    EXPECT_EQ(eyeAfterSome(), 5);
    pilot.say(Input{InputKind::Steer, {}, {.ahead = 7}});
    EXPECT_EQ(eyeAfterSome(), 7);
    EXPECT_EQ(status().pilot, "pilot");
    left.say(Input{InputKind::Steer, {}, {.ahead = 6}});  // still held, but not the latest
    EXPECT_EQ(eyeAfterSome(), 7);
    pilot.say(Input{InputKind::Steer, {}, {}});
    EXPECT_EQ(eyeAfterSome(), 0);
    EXPECT_NE(status().pilot, "pilot");
}

TEST_F(Reception, aSecondNodeOfANameWaitsUntilTheFirstIsSilent) {
    const StageMaster master(ConductorOptions{}, net_.master());
    Peer first(net_);
    Peer second(net_);
    first.say(Hello{"left", kProtocolMajor, ""});
    ASSERT_TRUE(first.hear<Welcome>());
    second.say(Hello{"left", kProtocolMajor, ""});
    const auto dismissed = second.hear<Dismissed>();
    ASSERT_TRUE(dismissed);
    EXPECT_THAT(dismissed->reason, testing::HasSubstr("another node of this name"));
    std::this_thread::sleep_for(milliseconds(300));
    second.say(Hello{"left", kProtocolMajor, ""});
    EXPECT_TRUE(second.hear<Welcome>());
    first.say(Ping{1});
    EXPECT_TRUE(first.hear<Dismissed>());
}

TEST_F(Reception, sendsAwayWhoSpeaksWithoutHelloOrOfAnotherRun) {
    const StageMaster master(ConductorOptions{}, net_.master());
    Peer stranger(net_);
    stranger.say(Ready{{3}, {}});
    EXPECT_TRUE(stranger.hear<Dismissed>());
    Peer node(net_);
    ASSERT_TRUE(node.join("left"));
    node.session ^= 2;
    node.say(Ping{1});
    EXPECT_TRUE(node.hear<Dismissed>());  // of the true run, by which it says farewell
}

TEST_F(Reception, aNodeThatSaysFarewellIsNotWaitedFor) {
    const StageMaster master(ConductorOptions{}, net_.master());
    Peer left(net_);
    ASSERT_TRUE(left.join("left"));
    ASSERT_TRUE(left.seeState());
    left.say(Farewell{});
    Peer right(net_);
    ASSERT_TRUE(right.join("right"));
    const auto state = right.seeState();
    ASSERT_TRUE(state);
    right.say(Ready{state->frame, {}});
    EXPECT_TRUE(right.hear<Present>());
    EXPECT_EQ(status().nodes[0].condition, NodeCondition::Absent);
}

TEST_F(Reception, whoSaysReadyTooEarlyOrTwiceChangesNothing) {
    const StageMaster master(lockstepOf({"left", "right"}), net_.master());
    Peer left(net_), right(net_);
    ASSERT_TRUE(left.join("left"));
    ASSERT_TRUE(right.join("right"));
    ASSERT_TRUE(left.seeState());
    left.say(Ready{{1}, {}});  // of a frame that nobody draws yet
    left.say(Ready{{0}, {}});
    left.say(Ready{{0}, {}});
    left.say(Ready{{~std::uint64_t{0}}, {}});
    EXPECT_TRUE(left.hearsNo<Present>(milliseconds(100)));
    right.say(Ready{{0}, {}});
    EXPECT_EQ(left.hear<Present>()->frame, Frame{0});
    EXPECT_EQ(right.hear<Present>()->frame, Frame{0});
}

TEST_F(Reception, aReleaseThatGotLostIsGivenAgain) {
    const StageMaster master(lockstepOf({"left"}), net_.master());
    Peer left(net_);
    ASSERT_TRUE(left.join("left"));
    ASSERT_TRUE(left.seeState());
    for (int times = 0; times < 3; ++times) {
        left.say(Ready{{0}, {}});
        const auto present = left.hear<Present>();
        ASSERT_TRUE(present);
        EXPECT_EQ(present->frame, Frame{0});
        EXPECT_EQ(present->atNs, 0);  // lockstep: at once
    }
}

TEST_F(Reception, noiseIsCountedAndChangesNothing) {
    const StageMaster master(lockstepOf({"left"}), net_.master());
    Peer left(net_);
    ASSERT_TRUE(left.join("left"));
    Peer stranger(net_);
    std::mt19937 random(1);
    for (int packet = 0; packet < 500; ++packet) {
        ByteVector noise(random() % 300);
        for (std::byte& byte : noise) byte = static_cast<std::byte>(random());
        stranger.sayNoise(noise);
    }
    for (std::uint64_t frame = 0; frame < 10; ++frame) {
        ASSERT_EQ(left.present(frame), frame);
    }
    EXPECT_GE(status().refusedPackets, 500U);
}

TEST_F(Reception, reportsReleaseSkewFromWhatNodesSay) {
    const StageMaster master(lockstepOf({"left", "right"}), net_.master());
    Peer left(net_), right(net_);
    ASSERT_TRUE(left.join("left"));
    ASSERT_TRUE(right.join("right"));
    for (std::uint64_t frame = 0; frame < 30; ++frame) {
        ASSERT_TRUE(left.seeState());
        Ready ready{{frame}, {}};
        const auto releasedAt = static_cast<std::int64_t>(frame) * 16'000'000;
        if (frame > 0) ready.released = ReleaseReport{{frame - 1}, releasedAt};
        left.say(ready);
        if (frame > 0) ready.released->atNs += 3'000'000;
        right.say(ready);
        ASSERT_TRUE(left.hear<Present>());
        ASSERT_TRUE(right.hear<Present>());
    }
    EXPECT_FLOAT_EQ(status().skewMedianMs, 3.0F);
    EXPECT_FLOAT_EQ(status().skewP99Ms, 3.0F);
}

// All nodes draw at one tier: the finest that each of them bears, also those that have left.
TEST_F(Reception, theSlowestNodeDecidesHowFineTheWallIsDrawn) {
    StageMaster master(lockstepOf({"left", "right"}), net_.master());
    Peer left(net_);
    Peer right(net_);
    ASSERT_TRUE(left.join("left", QualityTier::High));
    ASSERT_TRUE(right.join("right", QualityTier::Medium));
    const auto state = left.seeState();
    ASSERT_TRUE(state);
    EXPECT_EQ(state->quality, QualityTier::Medium);
}

TEST_F(Reception, aRigMaySayHowFineItsWallIsDrawn) {
    ConductorOptions options = lockstepOf({"left"});
    options.quality = QualityTier::Ultra;
    StageMaster master(options, net_.master());
    Peer left(net_);
    left.say(Hello{"left", kProtocolMajor, ""});
    const auto welcome = left.hear<Welcome>();
    ASSERT_TRUE(welcome);
    EXPECT_EQ(welcome->quality, QualityTier::Ultra);
    left.say(Prepared{QualityTier::Low});
    const auto state = left.seeState();
    ASSERT_TRUE(state);
    EXPECT_EQ(state->quality, QualityTier::Ultra);
}

TEST_F(Reception, writesWhenEachStateWentOut) {
    ConductorOptions options = lockstepOf({"left"});
    options.frames = 5;
    options.traceDirectory = freshDirectory();
    {
        StageMaster master(options, net_.master());
        Peer left(net_);
        ASSERT_TRUE(left.join("left"));
        for (std::uint64_t frame = 0; frame < 5; ++frame) {
            ASSERT_EQ(left.present(frame), frame);
        }
        ASSERT_TRUE(left.hear<Farewell>());
        EXPECT_EQ(master.report().frames, 5U);
    }
    std::ifstream file(options.traceDirectory / "master.csv");
    std::string line;
    ASSERT_TRUE(std::getline(file, line));
    EXPECT_EQ(line, "frame,state_ns,ready_ns,present_ns");
    std::int64_t last = 0;
    for (int frame = 0; frame < 5; ++frame) {
        ASSERT_TRUE(std::getline(file, line));
        EXPECT_THAT(line, testing::MatchesRegex(std::to_string(frame) + ",[0-9]+,,"));
        const std::int64_t published = std::stoll(line.substr(line.find(',') + 1));
        EXPECT_GT(published, last);
        last = published;
    }
    EXPECT_FALSE(std::getline(file, line));
    std::filesystem::remove_all(options.traceDirectory);
}

TEST_F(Reception, aTraceThatCannotBeWrittenIsAnErrorBeforeTheShow) {
    ConductorOptions options;
    options.traceDirectory = "/proc/nowhere";
    EXPECT_THROW(StageMaster(options, net_.master()), Error);
}

}  // namespace
}  // namespace aquarama
