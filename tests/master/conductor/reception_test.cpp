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

namespace aquarama::conductor {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

class Peer {
  public:
    explicit Peer(test::MemoryNet& net) : channels_(net.node()) { channels_->subscribeState(""); }
    ~Peer() { say(test::farewell()); }  // so that the master need not wait for it at the end
    Peer(const Peer&) = delete;
    Peer& operator=(const Peer&) = delete;

    void say(const v1::Envelope& message) {
        channels_->sendControl(wire::encode(session, message));
    }
    void sayNoise(const net::ByteVector& noise) { channels_->sendControl(noise); }

    // The next message of this kind, whatever comes between; empty after five seconds.
    std::optional<v1::Envelope> hear(v1::Envelope::MessageCase kind) {
        return await(
            kind, [&] { return channels_->receiveControl(); }, seconds(5));
    }
    bool hearsNo(v1::Envelope::MessageCase kind, net::Duration within) {
        return !await(
            kind, [&] { return channels_->receiveControl(); }, within);
    }
    std::optional<wire::StateFrame> seeState() {
        const auto message = await(
            v1::Envelope::kState, [&] { return channels_->receiveState(); }, seconds(5));
        auto coded = message ? wire::readState(message->state()) : std::nullopt;
        return coded ? std::optional(std::move(coded->frame)) : std::nullopt;
    }
    // Sees the state of this frame, says ready, and gives the frame that is presented then.
    std::optional<std::uint64_t> present(std::uint64_t frame) {
        std::optional<wire::StateFrame> state;
        do {
            state = seeState();
        } while (state && state->frame.value < frame);
        say(test::ready(frame));
        const auto present = hear(v1::Envelope::kPresent);
        return present ? std::optional{present->present().frame()} : std::nullopt;
    }
    // Hello, welcome, prepared: a member.
    bool join(const std::string& name, config::QualityTier bears = config::QualityTier::Low) {
        say(test::hello(name));
        if (!hear(v1::Envelope::kWelcome)) return false;
        say(test::prepared(bears));
        return hear(v1::Envelope::kJoined).has_value();
    }

    std::uint64_t session = 0;  // of the last message heard

  private:
    template <class Receive>
    std::optional<v1::Envelope> await(v1::Envelope::MessageCase kind,
                                      Receive receive,
                                      net::Duration within) {
        const net::Moment end = net::monotonicNow() + within;
        while (net::monotonicNow() < end) {
            while (const auto bytes = receive()) {
                auto message = wire::decode(*bytes);
                if (!message) continue;
                session = message->session();
                if (message->message_case() == kind) return message;
            }
            channels_->wait(milliseconds(5));
        }
        return std::nullopt;
    }

    std::unique_ptr<net::NodeChannels> channels_;
};

class Reception : public testing::Test {
  protected:
    static ConductorOptions lockstepOf(std::vector<std::string> names) {
        ConductorOptions options;
        options.pace = wire::Pace::Lockstep;
        options.expected = std::move(names);
        return options;
    }
    v1::StatusReply status() {
        Peer asker(net_);
        asker.say(test::statusRequest());
        return asker.hear(v1::Envelope::kStatusReply).value_or(v1::Envelope{}).status_reply();
    }

    test::MemoryNet net_;
};

TEST_F(Reception, refusesAnotherMajorVersionByName) {
    const test::StageMaster master(ConductorOptions{}, net_.master());
    Peer peer(net_);
    peer.say(test::hello("left", wire::kProtocolMajor + 1, "9.9.9"));
    const auto refusal = peer.hear(v1::Envelope::kRefusal);
    ASSERT_TRUE(refusal);
    EXPECT_THAT(refusal->refusal().reason(),
                testing::HasSubstr("protocol " + std::to_string(wire::kProtocolMajor + 1)));
    EXPECT_THAT(refusal->refusal().reason(), testing::HasSubstr("9.9.9"));
}

// Live, where the others do not wait for one: a state that all missed is sent again.
TEST_F(Reception, aStateThatNobodyAnswersComesAgain) {
    const test::StageMaster master(ConductorOptions{}, net_.master());
    Peer peer(net_);
    ASSERT_TRUE(peer.join("left"));
    const auto state = peer.seeState();
    const auto again = peer.seeState();
    ASSERT_TRUE(state && again);
    EXPECT_EQ(again->frame, state->frame);
    EXPECT_EQ(peer.present(state->frame.value), state->frame.value);
}

TEST_F(Reception, refusesAMachineWhoseMotorMovesFishElsewhere) {
    const test::StageMaster master(ConductorOptions{}, net_.master());
    Peer peer(net_);
    v1::Envelope hello = test::hello("left");
    hello.mutable_hello()->set_motor_hash(0x1234);
    peer.say(hello);
    const auto refusal = peer.hear(v1::Envelope::kRefusal);
    ASSERT_TRUE(refusal);
    EXPECT_THAT(refusal->refusal().reason(), testing::HasSubstr("0000000000001234"));
}

v1::Envelope setBlack(std::uint64_t request, bool black = true) {
    v1::Envelope message;
    message.mutable_order()->set_request(request);
    message.mutable_order()->mutable_show()->set_black(black);
    return message;
}

TEST_F(Reception, aNodeIsAskedToMakeWayOnceForEachRequest) {
    const test::StageMaster master(ConductorOptions{}, net_.master());
    Peer node(net_), asker(net_);
    ASSERT_TRUE(node.join("left"));
    const auto restart = [&](std::uint64_t request, const std::string& channel) {
        v1::Envelope message;
        message.mutable_order()->set_request(request);
        message.mutable_order()->mutable_restart()->set_channel(channel);
        asker.say(message);
        return asker.hear(v1::Envelope::kOrderReply).value_or(v1::Envelope{}).order_reply();
    };
    EXPECT_EQ(restart(1, "nobody").outcome(), v1::OrderReply::REFUSED);
    EXPECT_EQ(restart(2, "right").reason(), "right is absent: start it on its machine");
    EXPECT_EQ(restart(3, "left").outcome(), v1::OrderReply::DONE);
    EXPECT_TRUE(node.hear(v1::Envelope::kOrder));
    EXPECT_EQ(restart(3, "left").outcome(), v1::OrderReply::DONE) << "said again";
    EXPECT_TRUE(node.hearsNo(v1::Envelope::kOrder, milliseconds(200)));
}

class MachineSwitch : public Reception {
  protected:
    MachineSwitch() { EXPECT_TRUE(node.join("left")); }
    void report(bool takesPowerWord) {
        v1::Envelope message;
        message.mutable_node_report()->set_takes_power_word(takesPowerWord);
        node.say(message);
    }
    v1::OrderReply ask(std::uint64_t request, const std::string& channel = "left") {
        v1::Envelope message;
        v1::Order& order = *message.mutable_order();
        order.set_request(request);
        order.set_run(run == 0 ? node.session : run);
        order.mutable_power()->set_channel(channel);
        order.mutable_power()->set_word(v1::Power::REBOOT);
        asker.say(message);
        return asker.hear(v1::Envelope::kOrderReply).value_or(v1::Envelope{}).order_reply();
    }
    void answer(std::uint64_t request, const std::string& refusal) {
        v1::Envelope message;
        v1::OrderReply& reply = *message.mutable_order_reply();
        reply.set_request(request);
        reply.set_outcome(refusal.empty() ? v1::OrderReply::DONE : v1::OrderReply::REFUSED);
        reply.set_reason(refusal);
        node.say(message);
    }

    const test::StageMaster master{ConductorOptions{}, net_.master()};
    Peer node{net_}, asker{net_};
    std::uint64_t run = 0;  // that is named; 0: the master's
};

TEST_F(MachineSwitch, isToldOnceAndWhatItAnswersIsPassedOn) {
    report(true);
    EXPECT_EQ(ask(1).outcome(), v1::OrderReply::WAITING);
    const auto order = node.hear(v1::Envelope::kOrder);
    ASSERT_TRUE(order);
    EXPECT_EQ(order->order().power().word(), v1::Power::REBOOT);
    EXPECT_EQ(ask(1).outcome(), v1::OrderReply::WAITING) << "said again";
    answer(1, "");
    EXPECT_EQ(ask(1).outcome(), v1::OrderReply::DONE);
    EXPECT_EQ(ask(2).outcome(), v1::OrderReply::WAITING);
    ASSERT_TRUE(node.hear(v1::Envelope::kOrder));
    answer(2, "it takes no word");
    EXPECT_EQ(ask(2).reason(), "it takes no word");
    EXPECT_EQ(ask(1).outcome(), v1::OrderReply::DONE);
    EXPECT_TRUE(node.hearsNo(v1::Envelope::kOrder, milliseconds(200)));
}

TEST_F(MachineSwitch, isRefusedWhereNothingCouldComeOfIt) {
    EXPECT_THAT(ask(1).reason(), testing::HasSubstr("nothing is known of the machine of left"));
    report(false);
    EXPECT_THAT(ask(2).reason(), testing::HasSubstr("takes no such word"));
    report(true);
    EXPECT_EQ(ask(3, "right").reason(), "right is absent: start it on its machine");
    EXPECT_EQ(ask(4, "nobody").reason(), "the rig has no channel nobody");
    run = node.session + 1;
    EXPECT_THAT(ask(5).reason(), testing::HasSubstr("the show was started again meanwhile"));
    EXPECT_TRUE(node.hearsNo(v1::Envelope::kOrder, milliseconds(200)));
}

TEST_F(MachineSwitch, thatIsNotAnsweredSaysSoAndIsNotSaidAgain) {
    report(true);
    EXPECT_EQ(ask(1).outcome(), v1::OrderReply::WAITING);
    ASSERT_TRUE(node.hear(v1::Envelope::kOrder));
    v1::OrderReply reply;
    const net::Moment end = net::monotonicNow() + seconds(10);
    while ((reply = ask(1)).outcome() == v1::OrderReply::WAITING && net::monotonicNow() < end)
        EXPECT_TRUE(node.hearsNo(v1::Envelope::kOrder, milliseconds(200)));
    EXPECT_EQ(reply.outcome(), v1::OrderReply::LOST);
    EXPECT_THAT(reply.reason(), testing::HasSubstr("the machine of left has not answered"));
}

TEST_F(Reception, aWindowEndsTheShowOnlyWhereTheRigSaysSo) {
    config::Rig rig = test::StageMaster::deskRig();
    rig.windowsEndShow = false;
    const test::StageMaster master(ConductorOptions{}, net_.master(), rig);
    Peer node(net_);
    ASSERT_TRUE(node.join("left"));
    node.say(test::input(v1::INPUT_QUIT));
    EXPECT_TRUE(node.hearsNo(v1::Envelope::kFarewell, milliseconds(300)));
    EXPECT_EQ(status().refused_packets(), 1U);
}

TEST_F(Reception, refusesANameThatTheRigDoesNotHaveAndSaysWhichItHas) {
    const test::StageMaster master(ConductorOptions{}, net_.master());
    Peer peer(net_);
    peer.say(test::hello("ceiling"));
    const auto refusal = peer.hear(v1::Envelope::kRefusal);
    ASSERT_TRUE(refusal);
    EXPECT_THAT(refusal->refusal().reason(), testing::HasSubstr("left, middle, right"));
}

TEST_F(Reception, welcomesWithAllThatANodeNeeds) {
    ConductorOptions options;
    options.wanted.set_pattern(v1::WantedShow::GRID);
    const test::StageMaster master(options, net_.master());
    Peer peer(net_);
    peer.say(test::hello("left"));
    const auto message = peer.hear(v1::Envelope::kWelcome);
    ASSERT_TRUE(message);
    const v1::Welcome& welcome = message->welcome();
    EXPECT_EQ(config::parseRig(welcome.rig_text(), "welcome").channels.size(), 3U);
    EXPECT_EQ(welcome.state_address(), "memory:state");
    EXPECT_EQ(welcome.look().seed(), 77U);
    EXPECT_FALSE(welcome.look().world());
    EXPECT_EQ(welcome.look().fish_ids_size(), 3);
    net::BlobAssembly assembly(wire::digestIn(welcome.look().cast(0).repertoire()));
    while (!assembly.whole()) {
        peer.say(test::blobRequest(assembly.digest(), assembly.nextOffset()));
        const auto answer = peer.hear(v1::Envelope::kBlobChunk);
        ASSERT_TRUE(answer);
        const v1::BlobChunk& chunk = answer->blob_chunk();
        ASSERT_TRUE(assembly.take(
            chunk.offset(), chunk.total(), std::as_bytes(std::span{chunk.content()})));
    }
    EXPECT_EQ(assembly.checked(), test::StageMaster::repertoire());
}

// As of the status: a terminal is no node. Nobody draws, so the lockstep show stands still.
TEST_F(Reception, tellsAnybodyOfAMindAlsoWhileTheShowWaits) {
    const test::StageMaster master(lockstepOf({"left"}), net_.master());
    Peer asker(net_);
    asker.say(test::explainRequest(2));
    const auto message = asker.hear(v1::Envelope::kExplanation);
    ASSERT_TRUE(message);
    const v1::Explanation& explanation = message->explanation();
    EXPECT_EQ(explanation.fish(), 2U);
    EXPECT_EQ(explanation.school(), 3U);
    ASSERT_EQ(explanation.lines_size(), 1);
    EXPECT_EQ(explanation.lines(0), "at tick " + std::to_string(explanation.tick()));
    EXPECT_EQ(explanation.intention(), v1::Explanation::AVOID_FISH);
    EXPECT_EQ(explanation.target(), "#1 tang");
    EXPECT_EQ(explanation.pursued_s(), 1.5F);
    EXPECT_EQ(explanation.hunger(), 0.25F);
    EXPECT_EQ(explanation.libido(), 0.5F);
    EXPECT_EQ(explanation.fear(), 0.75F);
    ASSERT_EQ(explanation.seen_size(), 2);
    EXPECT_EQ(explanation.seen(0).kind(), v1::Sighting::FOOD);
    EXPECT_EQ(explanation.seen(0).name(), "particle 7");
    EXPECT_EQ(explanation.seen(0).distance_lengths(), 4);
    EXPECT_EQ(explanation.seen(0).degrees_right(), -90);
    EXPECT_EQ(explanation.seen(1).kind(), v1::Sighting::PREY);
}

// What is dropped is in the world from one of the next ticks on; lockstep runs a few ahead.
TEST_F(Reception, aVisitorFeedsTheFishWhereTheyCanBeReachedAndNotTooOften) {
    const test::StageMaster master(lockstepOf({"left"}), net_.master());
    Peer left(net_);
    ASSERT_TRUE(left.join("left"));
    const auto pellets = [](const wire::StateFrame& state) {
        return state.foodAfter.size() -
               static_cast<std::size_t>(std::ranges::count(state.foodAfter, wire::FoodRecord{}));
    };
    const auto feed = [&](glm::vec3 place) { left.say(test::dropFood(place)); };
    feed({0.5F, 0, -2.5F});
    for (int stuck = 0; stuck < 100; ++stuck) feed({0, 0, -2});
    std::optional<wire::StateFrame> state;
    for (std::uint64_t frame = 0; frame < 20; ++frame) {
        state = left.seeState();
        ASSERT_TRUE(state);
        left.say(test::ready(frame));
        ASSERT_TRUE(left.hear(v1::Envelope::kPresent));
    }
    EXPECT_EQ(pellets(*state), 1U);
    EXPECT_LT(glm::distance(state->foodAfter.front().offsetMetres() + state->foodOriginMetres,
                            {0.5F, 0, -2.5F}),
              1e-3F);
    const std::uint64_t refused = status().refused_packets();
    std::this_thread::sleep_for(milliseconds(250));
    feed({0, 100, 0});
    for (std::uint64_t frame = 20; frame < 40; ++frame) {
        state = left.seeState();
        ASSERT_TRUE(state);
        left.say(test::ready(frame));
        ASSERT_TRUE(left.hear(v1::Envelope::kPresent));
    }
    EXPECT_EQ(pellets(*state), 1U);
    EXPECT_EQ(status().refused_packets(), refused + 2);  // and the farewell of who asked before
}

// From a window's node as from a pilot that drives no channel; whoever has hold last.
TEST_F(Reception, handsMoveTheEye) {
    const test::StageMaster master(lockstepOf({"left"}), net_.master());
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
            left.say(test::ready(frame));
            if (!left.hear(v1::Envelope::kPresent)) return -1.0F;
        }
        return ahead;
    };
    left.say(test::steer({.ahead = 5}));
    EXPECT_EQ(eyeAfterSome(), 5);
    pilot.say(test::steer({.ahead = 7}));
    EXPECT_EQ(eyeAfterSome(), 7);
    EXPECT_EQ(status().show().pilot(), "pilot");
    left.say(test::steer({.ahead = 6}));  // still held, but not the latest
    EXPECT_EQ(eyeAfterSome(), 7);
    pilot.say(test::steer({}));
    EXPECT_EQ(eyeAfterSome(), 0);
    EXPECT_NE(status().show().pilot(), "pilot");
}

TEST_F(Reception, aSecondNodeOfANameWaitsUntilTheFirstIsSilent) {
    const test::StageMaster master(ConductorOptions{}, net_.master());
    Peer first(net_);
    Peer second(net_);
    first.say(test::hello("left"));
    ASSERT_TRUE(first.hear(v1::Envelope::kWelcome));
    second.say(test::hello("left"));
    const auto dismissed = second.hear(v1::Envelope::kDismissed);
    ASSERT_TRUE(dismissed);
    EXPECT_THAT(dismissed->dismissed().reason(), testing::HasSubstr("another node of this name"));
    std::this_thread::sleep_for(milliseconds(300));
    second.say(test::hello("left"));
    EXPECT_TRUE(second.hear(v1::Envelope::kWelcome));
    first.say(test::ping(1));
    EXPECT_TRUE(first.hear(v1::Envelope::kDismissed));
}

TEST_F(Reception, sendsAwayWhoSpeaksWithoutHelloOrOfAnotherRun) {
    const test::StageMaster master(ConductorOptions{}, net_.master());
    Peer stranger(net_);
    stranger.say(test::ready(3));
    EXPECT_TRUE(stranger.hear(v1::Envelope::kDismissed));
    Peer node(net_);
    ASSERT_TRUE(node.join("left"));
    node.session ^= 2;
    node.say(test::ping(1));
    EXPECT_TRUE(node.hear(v1::Envelope::kDismissed));  // of the true run, by which it says farewell
}

TEST_F(Reception, aNodeThatSaysFarewellIsNotWaitedFor) {
    const test::StageMaster master(ConductorOptions{}, net_.master());
    Peer left(net_);
    ASSERT_TRUE(left.join("left"));
    ASSERT_TRUE(left.seeState());
    left.say(test::farewell());
    Peer right(net_);
    ASSERT_TRUE(right.join("right"));
    const auto state = right.seeState();
    ASSERT_TRUE(state);
    right.say(test::ready(state->frame.value));
    EXPECT_TRUE(right.hear(v1::Envelope::kPresent));
    EXPECT_EQ(status().nodes(0).condition(), v1::NODE_ABSENT);
}

TEST_F(Reception, whoSaysReadyTooEarlyOrTwiceChangesNothing) {
    const test::StageMaster master(lockstepOf({"left", "right"}), net_.master());
    Peer left(net_), right(net_);
    ASSERT_TRUE(left.join("left"));
    ASSERT_TRUE(right.join("right"));
    ASSERT_TRUE(left.seeState());
    left.say(test::ready(1));  // of a frame that nobody draws yet
    left.say(test::ready(0));
    left.say(test::ready(0));
    left.say(test::ready(~std::uint64_t{0}));
    EXPECT_TRUE(left.hearsNo(v1::Envelope::kPresent, milliseconds(100)));
    right.say(test::ready(0));
    EXPECT_EQ(left.hear(v1::Envelope::kPresent)->present().frame(), 0U);
    EXPECT_EQ(right.hear(v1::Envelope::kPresent)->present().frame(), 0U);
}

TEST_F(Reception, aReleaseThatGotLostIsGivenAgain) {
    const test::StageMaster master(lockstepOf({"left"}), net_.master());
    Peer left(net_);
    ASSERT_TRUE(left.join("left"));
    ASSERT_TRUE(left.seeState());
    for (int times = 0; times < 3; ++times) {
        left.say(test::ready(0));
        const auto present = left.hear(v1::Envelope::kPresent);
        ASSERT_TRUE(present);
        EXPECT_EQ(present->present().frame(), 0U);
        EXPECT_EQ(present->present().at_ns(), 0);  // lockstep: at once
    }
}

TEST_F(Reception, noiseIsCountedAndChangesNothing) {
    const test::StageMaster master(lockstepOf({"left"}), net_.master());
    Peer left(net_);
    ASSERT_TRUE(left.join("left"));
    Peer stranger(net_);
    std::mt19937 random(1);
    for (int packet = 0; packet < 500; ++packet) {
        net::ByteVector noise(random() % 300);
        for (std::byte& byte : noise) byte = static_cast<std::byte>(random());
        stranger.sayNoise(noise);
    }
    for (std::uint64_t frame = 0; frame < 10; ++frame) {
        ASSERT_EQ(left.present(frame), frame);
    }
    EXPECT_GE(status().refused_packets(), 500U);
}

TEST_F(Reception, reportsReleaseSkewFromWhatNodesSay) {
    const test::StageMaster master(lockstepOf({"left", "right"}), net_.master());
    Peer left(net_), right(net_);
    ASSERT_TRUE(left.join("left"));
    ASSERT_TRUE(right.join("right"));
    for (std::uint64_t frame = 0; frame < 30; ++frame) {
        ASSERT_TRUE(left.seeState());
        const auto at = static_cast<std::int64_t>(frame) * 16'000'000;
        left.say(frame == 0 ? test::ready(0) : test::ready(frame, frame - 1, at));
        right.say(frame == 0 ? test::ready(0) : test::ready(frame, frame - 1, at + 3'000'000));
        ASSERT_TRUE(left.hear(v1::Envelope::kPresent));
        ASSERT_TRUE(right.hear(v1::Envelope::kPresent));
    }
    EXPECT_FLOAT_EQ(status().skew_median_ms(), 3.0F);
    EXPECT_FLOAT_EQ(status().skew_p99_ms(), 3.0F);
    EXPECT_FLOAT_EQ(status().skew_peak_ms(), 3.0F);
    EXPECT_GT(status().frame_peak_ms(), 0);
}

TEST_F(Reception, tellsTheLongestPictureOfEachNode) {
    const test::StageMaster master(lockstepOf({"left", "right"}), net_.master());
    Peer left(net_), right(net_);
    ASSERT_TRUE(left.join("left"));
    ASSERT_TRUE(right.join("right"));
    for (std::uint64_t frame = 0; frame < 5; ++frame) {
        ASSERT_TRUE(left.seeState());
        v1::Envelope ready = test::ready(frame);
        ready.mutable_ready()->set_picture_us(frame == 4 ? 30'500 : 9000);
        left.say(ready);
        right.say(test::ready(frame));  // of an older build: says nothing of it
        ASSERT_TRUE(left.hear(v1::Envelope::kPresent));
    }
    EXPECT_FLOAT_EQ(status().nodes(0).picture_ms(), 30.5F);
    EXPECT_FLOAT_EQ(status().nodes(1).picture_ms(), 0);
}

// All nodes draw at one tier: the finest that each of them bears, also those that have left.
TEST_F(Reception, theSlowestNodeDecidesHowFineTheWallIsDrawn) {
    test::StageMaster master(lockstepOf({"left", "right"}), net_.master());
    Peer left(net_);
    Peer right(net_);
    ASSERT_TRUE(left.join("left", config::QualityTier::High));
    ASSERT_TRUE(right.join("right", config::QualityTier::Medium));
    const auto state = left.seeState();
    ASSERT_TRUE(state);
    EXPECT_EQ(state->show.quality, config::QualityTier::Medium);
}

TEST_F(Reception, aRigMaySayHowFineItsWallIsDrawn) {
    ConductorOptions options = lockstepOf({"left"});
    options.wanted.set_quality(v1::WantedShow::ULTRA);
    test::StageMaster master(options, net_.master());
    Peer left(net_);
    left.say(test::hello("left"));
    const auto welcome = left.hear(v1::Envelope::kWelcome);
    ASSERT_TRUE(welcome);
    EXPECT_EQ(config::tierAt(welcome->welcome().look().quality()), config::QualityTier::Ultra);
    left.say(test::prepared(config::QualityTier::Low));
    const auto state = left.seeState();
    ASSERT_TRUE(state);
    EXPECT_EQ(state->show.quality, config::QualityTier::Ultra);
}

TEST_F(Reception, aShowInLockstepCannotBeChanged) {
    const test::StageMaster master(lockstepOf({"left"}), net_.master());
    Peer asker(net_);
    asker.say(setBlack(1));
    const auto reply = asker.hear(v1::Envelope::kOrderReply);
    ASSERT_TRUE(reply);
    EXPECT_EQ(reply->order_reply().outcome(), v1::OrderReply::REFUSED);
    EXPECT_THAT(reply->order_reply().reason(), testing::HasSubstr("lockstep"));
}

TEST_F(Reception, whatCannotBeShownIsRefusedByName) {
    const test::StageMaster master(ConductorOptions{}, net_.master());
    Peer asker(net_);
    const auto refusal = [&](auto alter) {
        static std::uint64_t request = 0;
        v1::Envelope message;
        message.mutable_order()->set_request(++request);
        alter(*message.mutable_order()->mutable_show());
        asker.say(message);
        const auto reply =
            asker.hear(v1::Envelope::kOrderReply).value_or(v1::Envelope{}).order_reply();
        EXPECT_EQ(reply.outcome(), v1::OrderReply::REFUSED);
        return reply.reason();
    };
    EXPECT_THAT(refusal([](v1::WantedShow& s) { s.set_scene("reef"); }),
                testing::HasSubstr("one scene"));
    EXPECT_THAT(refusal([](v1::WantedShow& s) { s.set_scene("a/b"); }),
                testing::HasSubstr("one scene"));
    EXPECT_THAT(refusal([](v1::WantedShow& s) { s.set_quality(v1::WantedShow::AUTO); }),
                testing::HasSubstr("measured"));
    EXPECT_EQ(status().show().version(), 1U);
}

// A node that missed the announcement of a look would draw another one than the wall.
TEST_F(Reception, aNodeThatBuiltWhatTheWallDoesNotShowHasToJoinAnew) {
    const test::StageMaster master(ConductorOptions{}, net_.master());
    Peer left(net_);
    left.say(test::hello("left"));
    ASSERT_TRUE(left.hear(v1::Envelope::kWelcome));
    left.say(test::prepared(config::QualityTier::Low, 7));
    EXPECT_TRUE(left.hear(v1::Envelope::kDismissed));
    EXPECT_TRUE(left.join("left"));
}

TEST_F(Reception, writesWhenEachStateWentOut) {
    ConductorOptions options = lockstepOf({"left"});
    options.frames = 5;
    options.traceDirectory = test::freshDirectory();
    {
        test::StageMaster master(options, net_.master());
        Peer left(net_);
        ASSERT_TRUE(left.join("left"));
        for (std::uint64_t frame = 0; frame < 5; ++frame) {
            ASSERT_EQ(left.present(frame), frame);
        }
        ASSERT_TRUE(left.hear(v1::Envelope::kFarewell));
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
    EXPECT_THROW(test::StageMaster(options, net_.master()), Error);
}

}  // namespace
}  // namespace aquarama::conductor
