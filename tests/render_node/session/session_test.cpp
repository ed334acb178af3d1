// SPDX-License-Identifier: Apache-2.0
// A session against a master that says whatever a test wants it to say.
#include "render_node/session/session.h"

#include <cstdlib>
#include <fstream>
#include <future>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/net/blob.h"
#include "render_node/session/dead_reckoning.h"
#include "tests/render_node/session/listed_skins.h"
#include "tests/support/await.h"
#include "tests/support/stage.h"
#include "tests/support/state_packet.h"

namespace aquarama::session {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::uint64_t kRun = 42;

v1::Welcome deskWelcome() {
    v1::Welcome welcome;
    welcome.set_rig_text(test::StageMaster::deskRig().text);
    welcome.set_pace(v1::PACE_LIVE);
    v1::Look& look = *welcome.mutable_look();
    look = conductor::lookOf(test::StageMaster::assets(), test::StageMaster::school());
    look.set_number(1);
    look.set_world(true);
    return welcome;
}

conductor::Blobs deskBlobs() {
    return conductor::blobsOf(test::StageMaster::assets());
}

// The master's side, in the test's own thread.
class ScriptedMaster {
  public:
    explicit ScriptedMaster(test::MemoryNet& net) : channels_(net.master()) {}

    void say(const v1::Envelope& message) {
        channels_->sendControl(peer_, wire::encode(run, message));
    }
    void publish(const v1::Envelope& message) {
        channels_->publishState(wire::encode(run, message));
    }
    void sayNoise(const net::ByteVector& noise) {
        channels_->sendControl(peer_, noise);
        channels_->publishState(noise);
    }

    // The next message of this kind from the node; answers pings on the way. Empty after ten
    // seconds.
    std::optional<v1::Envelope> hear(v1::Envelope::MessageCase kind,
                                     net::Duration within = seconds(10)) {
        const net::Moment end = net::monotonicNow() + within;
        while (net::monotonicNow() < end) {
            while (const auto from = channels_->receiveControl()) {
                auto message = wire::decode(from->bytes);
                if (!message) continue;
                peer_ = from->peer;
                if (message->has_ping()) {
                    say(test::pong(message->ping().sent_ns(),
                                   (net::monotonicNow() + clockAhead).time_since_epoch().count()));
                }
                if (message->message_case() == kind) return message;
            }
            channels_->wait(milliseconds(5));
        }
        return std::nullopt;
    }

    // Everything up to the node's first frame, delivering these bytes for each blob.
    void admit(const conductor::Blobs& blobs, wire::Pace pace = wire::Pace::Live) {
        ASSERT_TRUE(hear(v1::Envelope::kHello));
        v1::Welcome welcome = deskWelcome();
        welcome.set_pace(static_cast<v1::Pace>(pace));
        say(test::welcome(welcome));
        giveBlobs(blobs, 2);
    }
    void giveBlobs(const conductor::Blobs& blobs, int count) {
        while (count > 0) {
            const auto request = hear(v1::Envelope::kBlobRequest);
            ASSERT_TRUE(request);
            const Digest digest = wire::digestIn(request->blob_request().digest());
            const std::uint64_t offset = request->blob_request().offset();
            const auto& blob = *blobs.at(digest);
            const auto chunk = net::chunkAt(blob, offset, wire::kBlobChunkBytes);
            say(test::blobChunk(digest, offset, blob.size(), chunk));
            if (offset + chunk.size() == blob.size()) --count;
            ++chunksGiven;
        }
    }
    void letIn(Frame first) {
        const net::Moment end = net::monotonicNow() + seconds(10);
        std::optional<v1::Envelope> prepared;
        while (!prepared && net::monotonicNow() < end) {
            publish(test::beacon());  // until the node has subscribed
            prepared = hear(v1::Envelope::kPrepared, milliseconds(50));
        }
        ASSERT_TRUE(prepared);
        say(test::joined(first.value));
    }
    void show(std::uint64_t frame,
              const std::optional<Digest>& skins = {},
              std::uint32_t look = 1) {
        wire::StateFrame state;
        state.show.skins = skins;
        state.show.look = look;
        state.after.resize(test::StageMaster::school().size());
        state.frame = {frame};
        state.show.calibration = shortHash(digestOf(test::StageMaster::deskRig().text));
        channels_->publishState(test::packetOf(run, state));
    }

    std::uint64_t run = kRun;
    net::Duration clockAhead{};
    int chunksGiven = 0;

  private:
    std::unique_ptr<net::MasterChannels> channels_;
    net::PeerId peer_;
};

class SessionTest : public testing::Test {
  protected:
    SessionTest() : master_(net_), blobs_(test::freshDirectory()), session_(connect()) {}
    ~SessionTest() override {
        session_.reset();
        std::filesystem::remove_all(blobs_);
    }

    std::unique_ptr<Session> connect() {
        return makeSession(
            "left", [this] { return net_.node(); }, blobs_);
    }
    // join() in a thread, while the master plays its part here.
    std::future<std::optional<Admission>> joining() {
        return std::async(std::launch::async, [this] { return session_->join(); });
    }
    // What join() threw; empty where it did not.
    static std::string errorOf(std::future<std::optional<Admission>> join) {
        try {
            join.get();
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }
    void prepare(const std::optional<Admission>& admission) {
        ASSERT_TRUE(admission);
        session_->prepared(1, config::QualityTier::Low, test::stillMotion(*admission));
    }
    void becomeMember(wire::Pace pace, Frame first) {
        auto join = joining();
        master_.admit(deskBlobs(), pace);
        prepare(join.get());
        master_.letIn(first);
    }
    std::uint64_t nextFrame() { return session_->nextFrame().value().frame.value; }
    std::future<Release> readying(std::uint64_t frame) {
        return std::async(std::launch::async,
                          [this, frame] { return session_->readyThenWait({frame}); });
    }

    test::MemoryNet net_;
    ScriptedMaster master_;
    std::filesystem::path blobs_;
    std::unique_ptr<Session> session_;
};

TEST_F(SessionTest, joinsWithRigSpeciesAndRepertoire) {
    auto join = joining();
    master_.admit(deskBlobs());
    const auto admission = join.get();
    ASSERT_TRUE(admission);
    EXPECT_EQ(admission->rig.channels.size(), 3U);
    EXPECT_EQ(admission->cast.at(0).text, test::StageMaster::assets().cast.at(0).text);
    EXPECT_EQ(admission->cast.at(0).repertoire, test::StageMaster::repertoire());
    EXPECT_EQ(admission->school.size(), 3U);
    EXPECT_GT(master_.chunksGiven, 3);
}

TEST_F(SessionTest, takesFromItsCacheWhatItOnceFetched) {
    auto join = joining();
    master_.admit(deskBlobs());
    ASSERT_TRUE(join.get());
    session_ = connect();
    join = joining();
    ASSERT_TRUE(master_.hear(v1::Envelope::kHello));
    master_.say(test::welcome(deskWelcome()));
    EXPECT_TRUE(join.get());  // no chunk was given
}

TEST_F(SessionTest, refusesABlobThatIsNotWhatItsNameSays) {
    conductor::Blobs altered = deskBlobs();
    net::Blob& text = altered.at(digestOf(test::StageMaster::assets().cast[0].text));
    text = std::make_shared<const net::ByteVector>(text->size(), std::byte{1});
    auto join = joining();
    master_.admit(altered);  // delivered twice here, and a third time below
    master_.giveBlobs(altered, 1);
    EXPECT_THAT(errorOf(std::move(join)), testing::HasSubstr("than its name says"));
    EXPECT_TRUE(std::filesystem::is_empty(blobs_));
}

// A member that is silent while it checks and writes a raw map of 4K is taken for gone.
TEST_F(SessionTest, answersWhileItChecksALargeBlob) {
    becomeMember(wire::Pace::Live, {5});
    const auto map = std::make_shared<const net::ByteVector>(std::size_t{3840} * 2160 * 12 + 25);
    const Digest digest = digestOf(std::span{*map});
    v1::Envelope prepare;
    v1::Look& look = *prepare.mutable_prepare()->mutable_look();
    look = deskWelcome().look();
    look.set_number(2);
    look.add_rig_files()->set_name("hall.pfm");
    look.mutable_rig_files(0)->set_digest(wire::bytesOf(digest));
    master_.say(prepare);
    master_.giveBlobs({{digest, map}}, 1);
    look.set_number(1);  // which it has built, and says so at once
    master_.say(prepare);
    ASSERT_TRUE(master_.hear(v1::Envelope::kPrepared));
    EXPECT_FALSE(session_->nextLook());
    EXPECT_FALSE(std::filesystem::exists(blobs_ / toHex(digest)));  // it is still being checked
    std::optional<Admission> next;
    while (!(next = session_->nextLook()))
        ASSERT_TRUE(master_.hear(v1::Envelope::kPing)) << "it has fallen silent";
    EXPECT_EQ(next->look, 2U);
    EXPECT_EQ(*next->rig.files.at("hall.pfm"), *map);
    EXPECT_EQ(net::BlobCache(blobs_).find(digest), *map);
}

TEST_F(SessionTest, leavesTheWordForItsMachineOrSaysWhyNot) {
    const std::filesystem::path folder = test::freshDirectory();
    std::filesystem::create_directories(folder);
    setenv("AQUARAMA_POWER_FOLDER", folder.c_str(), 1);
    becomeMember(wire::Pace::Live, {5});
    EXPECT_TRUE(master_.hear(v1::Envelope::kNodeReport)->node_report().takes_power_word());
    v1::Envelope order;
    order.mutable_order()->set_request(7);
    order.mutable_order()->set_run(1);
    order.mutable_order()->mutable_power()->set_channel("left");
    order.mutable_order()->mutable_power()->set_word(v1::Power::POWEROFF);
    master_.say(order);
    const auto done = master_.hear(v1::Envelope::kOrderReply);
    ASSERT_TRUE(done);
    EXPECT_EQ(done->order_reply().request(), 7U);
    EXPECT_EQ(done->order_reply().outcome(), v1::OrderReply::DONE);
    std::string word;
    EXPECT_TRUE(std::getline(std::ifstream(folder / "word"), word));
    EXPECT_EQ(word, "poweroff");
    std::filesystem::remove_all(folder);
    master_.say(order);
    const auto refused = master_.hear(v1::Envelope::kOrderReply);
    ASSERT_TRUE(refused);
    EXPECT_THAT(refused->order_reply().reason(), testing::HasSubstr("takes no such word"));
    EXPECT_FALSE(std::filesystem::exists(folder));
    unsetenv("AQUARAMA_POWER_FOLDER");
}

TEST_F(SessionTest, aRefusalIsAnErrorThatSaysWhy) {
    auto join = joining();
    ASSERT_TRUE(master_.hear(v1::Envelope::kHello));
    master_.say(test::refusal("it speaks protocol 2"));
    const std::string error = errorOf(std::move(join));
    EXPECT_THAT(error, testing::HasSubstr("\"left\""));
    EXPECT_THAT(error, testing::HasSubstr("protocol 2"));
}

TEST_F(SessionTest, aRigThatCannotBeReadIsAnError) {
    auto join = joining();
    ASSERT_TRUE(master_.hear(v1::Envelope::kHello));
    v1::Welcome welcome = deskWelcome();
    welcome.set_rig_text("name: \"desk\" colour: \"red\"");
    master_.say(test::welcome(welcome));
    master_.giveBlobs(deskBlobs(), 2);
    EXPECT_THAT(errorOf(std::move(join)), testing::HasSubstr("colour"));
}

TEST_F(SessionTest, aSceneThatCannotBeReadIsAnError) {
    auto join = joining();
    ASSERT_TRUE(master_.hear(v1::Envelope::kHello));
    v1::Welcome welcome = deskWelcome();
    welcome.mutable_look()->set_scene_text("name: \"reef\" mermaids: 3");
    master_.say(test::welcome(welcome));
    master_.giveBlobs(deskBlobs(), 2);
    EXPECT_THAT(errorOf(std::move(join)), testing::HasSubstr("mermaids"));
}

TEST_F(SessionTest, goesOnSayingHelloUntilItIsHeard) {
    auto join = joining();
    for (int times = 0; times < 3; ++times) ASSERT_TRUE(master_.hear(v1::Envelope::kHello));
    master_.say(test::dismissed("another node of this name takes part already"));
    ASSERT_TRUE(master_.hear(v1::Envelope::kHello));
    master_.admit(deskBlobs());
    EXPECT_TRUE(join.get());
}

TEST_F(SessionTest, isPreparedOnlyOnceItHearsTheStates) {
    auto join = joining();
    master_.admit(deskBlobs());
    prepare(join.get());
    EXPECT_FALSE(master_.hear(v1::Envelope::kPrepared, milliseconds(200)));
    master_.publish(test::beacon());
    EXPECT_TRUE(master_.hear(v1::Envelope::kPrepared));
}

// A node that was just restarted draws the drawings that its neighbours draw.
TEST_F(SessionTest, isPreparedOnlyOnceItHasTheDrawingsOfTheFirstList) {
    conductor::Blobs skins;
    const Digest list =
        test::offerSkins({{7, test::plainSkin(200)}, {8, test::plainSkin(9)}}, skins);
    auto join = joining();
    master_.admit(deskBlobs());
    prepare(join.get());
    master_.show(40, list);
    EXPECT_FALSE(master_.hear(v1::Envelope::kPrepared, milliseconds(300)));
    master_.giveBlobs(skins, 2);
    EXPECT_FALSE(master_.hear(v1::Envelope::kPrepared, milliseconds(100))) << "one is missing";
    master_.giveBlobs(skins, 1);
    ASSERT_TRUE(master_.hear(v1::Envelope::kPrepared));
    const auto shown = session_->newSkins();
    ASSERT_TRUE(shown);
    EXPECT_EQ(shown->size(), 2U);
    EXPECT_FALSE(session_->newSkins()) << "each is told once";
    for (const auto& [digest, blob] : skins)
        EXPECT_FALSE(std::filesystem::exists(blobs_ / toHex(digest))) << "it is on the disk";
}

// The wall does not wait for ever for a picture that does not come.
TEST_F(SessionTest, isPreparedAfterSecondsWithoutTheDrawings) {
    conductor::Blobs skins;
    const Digest list = test::offerSkins({{7, test::plainSkin(200)}}, skins);
    auto join = joining();
    master_.admit(deskBlobs());
    prepare(join.get());
    const net::Moment began = net::monotonicNow();
    master_.show(40, list);
    ASSERT_TRUE(master_.hear(v1::Envelope::kPrepared));
    EXPECT_GE(net::monotonicNow() - began, seconds(4));
}

// While frames are shown, and beside the blobs of the next look.
TEST_F(SessionTest, fetchesDrawingsBesideTheNextLook) {
    becomeMember(wire::Pace::Live, {5});
    conductor::Blobs blobs;
    const Digest list = test::offerSkins({{7, test::plainSkin(200)}}, blobs);
    const auto map = std::make_shared<const net::ByteVector>(2 * wire::kBlobChunkBytes);
    const Digest digest = digestOf(std::span{*map});
    blobs[digest] = map;
    v1::Envelope prepare;
    v1::Look& look = *prepare.mutable_prepare()->mutable_look();
    look = deskWelcome().look();
    look.set_number(2);
    look.add_rig_files()->set_name("hall.pfm");
    look.mutable_rig_files(0)->set_digest(wire::bytesOf(digest));
    master_.say(prepare);
    master_.show(5, list);
    master_.giveBlobs(blobs, 3);
    std::shared_ptr<const body::SkinsByNumber> skins;
    ASSERT_TRUE(test::comesTrue([&] {
        if (auto others = session_->newSkins()) skins = std::move(others);
        return skins && skins->contains(7);
    }));
    ASSERT_TRUE(test::comesTrue([&] { return session_->nextLook().has_value(); }));
}

TEST_F(SessionTest, speaksWhileItsRenderThreadIsBusy) {
    auto join = joining();
    master_.admit(deskBlobs());
    ASSERT_TRUE(join.get());
    for (int ping = 0; ping < 5; ++ping) EXPECT_TRUE(master_.hear(v1::Envelope::kPing));
}

TEST_F(SessionTest, saysReadyAndWaitsForTheRelease) {
    becomeMember(wire::Pace::Lockstep, {7});
    master_.show(7);
    EXPECT_EQ(nextFrame(), 7U);
    auto release = readying(7);
    EXPECT_EQ(master_.hear(v1::Envelope::kReady)->ready().frame(), 7U);
    EXPECT_EQ(release.wait_for(milliseconds(50)), std::future_status::timeout);
    master_.say(test::present(7, 0));
    EXPECT_EQ(release.get(), Release::Present);
    EXPECT_GT(session_->stateArrival(), net::Moment{});
}

TEST_F(SessionTest, letsGoAtTheAppointedTimeOfTheMastersClock) {
    master_.clockAhead = seconds(1000);
    becomeMember(wire::Pace::Live, {0});
    for (int ping = 0; ping < 12; ++ping) ASSERT_TRUE(master_.hear(v1::Envelope::kPing));
    master_.show(0);
    EXPECT_EQ(nextFrame(), 0U);
    auto release = readying(0);
    ASSERT_TRUE(master_.hear(v1::Envelope::kReady));
    const net::Moment at = net::monotonicNow() + milliseconds(200);
    master_.say(test::present(0, (at + master_.clockAhead).time_since_epoch().count()));
    EXPECT_EQ(release.get(), Release::Present);
    // Never before; but the clock's offset is known to half the shortest round trip of twelve.
    EXPECT_GE(net::monotonicNow(), at - milliseconds(50));
    master_.show(1);
    EXPECT_EQ(nextFrame(), 1U);
    release = readying(1);
    const auto message = master_.hear(v1::Envelope::kReady);
    ASSERT_TRUE(message);
    const v1::Ready& ready = message->ready();
    ASSERT_TRUE(ready.has_released_frame());
    EXPECT_EQ(ready.released_frame(), 0U);
    EXPECT_GE(net::Moment{net::Duration{ready.released_ns()}},
              at + master_.clockAhead - milliseconds(100));
    session_->stop();
    release.get();
}

TEST_F(SessionTest, aReleaseInAFarFutureIsTakenForAClockGoneWrong) {
    becomeMember(wire::Pace::Live, {0});
    for (int ping = 0; ping < 3; ++ping) ASSERT_TRUE(master_.hear(v1::Envelope::kPing));
    master_.show(0);
    EXPECT_EQ(nextFrame(), 0U);
    auto release = readying(0);
    master_.say(test::present(0, std::numeric_limits<std::int64_t>::max() / 2));
    EXPECT_EQ(release.get(), Release::Present);  // the suite's budget would stop it
}

TEST_F(SessionTest, asksAgainForAReleaseThatDoesNotCome) {
    becomeMember(wire::Pace::Lockstep, {0});
    master_.show(0);
    EXPECT_EQ(nextFrame(), 0U);
    auto release = readying(0);
    EXPECT_TRUE(master_.hear(v1::Envelope::kReady));
    EXPECT_TRUE(master_.hear(v1::Envelope::kReady));
    master_.say(test::present(0, 0));
    release.get();
}

TEST_F(SessionTest, skipsAFrameThatTheWallHasOvertakenButNotTwoInARow) {
    becomeMember(wire::Pace::Live, {0});
    for (const auto& [frame, wallIsAt, expected] :
         {std::tuple{0, 4, Release::Skip}, {5, 9, Release::Present}, {10, 15, Release::Skip}}) {
        master_.show(static_cast<std::uint64_t>(frame));
        EXPECT_EQ(nextFrame(), static_cast<std::uint64_t>(frame));
        master_.say(test::present(static_cast<std::uint64_t>(wallIsAt), 0));
        EXPECT_EQ(readying(static_cast<std::uint64_t>(frame)).get(), expected);
    }
}

TEST_F(SessionTest, theLastFrameIsPresentedBeforeTheEnd) {
    becomeMember(wire::Pace::Lockstep, {0});
    master_.show(0);
    EXPECT_EQ(nextFrame(), 0U);
    auto release = readying(0);
    ASSERT_TRUE(master_.hear(v1::Envelope::kReady));
    master_.say(test::present(0, 0));
    master_.say(test::farewell());
    EXPECT_EQ(release.get(), Release::Present);
    EXPECT_FALSE(session_->nextFrame());
    EXPECT_EQ(session_->interruption(), Release::Quit);
    EXPECT_FALSE(session_->join());
}

TEST_F(SessionTest, joinsAgainWhenItIsDismissed) {
    becomeMember(wire::Pace::Live, {0});
    master_.say(test::dismissed("you were silent for too long"));
    EXPECT_FALSE(session_->nextFrame());
    EXPECT_EQ(session_->interruption(), Release::Rejoin);
    auto join = joining();
    ASSERT_TRUE(master_.hear(v1::Envelope::kHello));
    master_.say(test::welcome(deskWelcome()));
    EXPECT_TRUE(join.get());
}

TEST_F(SessionTest, reportsItsMachineAtOnceWhenItJoinsAgain) {
    becomeMember(wire::Pace::Live, {0});
    ASSERT_TRUE(master_.hear(v1::Envelope::kNodeReport));
    master_.say(test::dismissed("you were silent for too long"));
    EXPECT_FALSE(session_->nextFrame());
    auto join = joining();
    ASSERT_TRUE(master_.hear(v1::Envelope::kHello));
    master_.say(test::welcome(deskWelcome()));
    prepare(join.get());
    master_.letIn({9});
    // The next of its own accord would come 5 s after the first.
    EXPECT_TRUE(master_.hear(v1::Envelope::kNodeReport, seconds(3)));
}

TEST_F(SessionTest, joinsAgainWhenTheMasterWasStartedAgain) {
    becomeMember(wire::Pace::Live, {0});
    master_.run = kRun + 2;
    master_.show(900);
    EXPECT_FALSE(session_->nextFrame());
    EXPECT_EQ(session_->interruption(), Release::Rejoin);
}

// A master that was held up, while another became the master.
TEST_F(SessionTest, aMasterOfAnOlderLeaseIsNotHeard) {
    becomeMember(wire::Pace::Live, {0});
    const auto farewellBy = [](std::uint64_t lease) {
        v1::Envelope message = test::farewell();
        message.set_lease_revision(lease);
        return message;
    };
    v1::Envelope newer = test::pong(1, 2);
    newer.set_lease_revision(20);
    master_.say(newer);
    master_.say(farewellBy(19));
    master_.say(test::farewell());  // without a lease
    auto next = std::async(std::launch::async, [&] { return session_->nextFrame().has_value(); });
    EXPECT_EQ(next.wait_for(milliseconds(300)), std::future_status::timeout);
    master_.say(farewellBy(20));
    EXPECT_FALSE(next.get());
    EXPECT_EQ(session_->interruption(), Release::Quit);
}

// A master that falls silent before a node that shows its fish.
class ReckoningTest : public SessionTest {
  protected:
    // A member that has shown frames 3 and 4 of the master.
    ReckoningTest() {
        becomeMember(wire::Pace::Live, {3});
        for (const std::uint64_t frame : {3U, 4U}) {
            master_.show(frame);
            EXPECT_EQ(nextFrame(), frame);
            auto release = readying(frame);
            EXPECT_TRUE(master_.hear(v1::Envelope::kReady));
            master_.say(test::present(frame, 0));
            EXPECT_EQ(release.get(), Release::Present);
        }
    }
    // Another run of the master welcomes it.
    v1::Welcome welcomeAs(std::uint64_t run, std::uint32_t look, std::uint32_t seed = 77) {
        master_.run = run;
        EXPECT_TRUE(master_.hear(v1::Envelope::kHello));
        v1::Welcome welcome = deskWelcome();
        welcome.mutable_look()->set_number(look);
        welcome.mutable_look()->set_seed(seed);
        master_.say(test::welcome(welcome));
        return welcome;
    }
    // Shows what comes next; its number.
    std::uint64_t shown() {
        const auto state = session_->nextFrame();
        if (!state) return 0;
        EXPECT_EQ(session_->readyThenWait(state->frame), Release::Present);
        return state->frame.value;
    }
    // As the render thread does, until a frame of the master comes; empty: interrupted, or none
    // came in 20 s.
    std::future<std::optional<std::uint64_t>> showingUntilLed() {
        return std::async(std::launch::async, [this]() -> std::optional<std::uint64_t> {
            const net::Moment end = net::monotonicNow() + seconds(20);
            while (const auto state = session_->nextFrame()) {
                if (net::monotonicNow() > end) break;
                if (!session_->isReckoned()) return state->frame.value;
                if (session_->readyThenWait(state->frame) != Release::Present) break;
            }
            return std::nullopt;
        });
    }
};

TEST_F(ReckoningTest, makesItsOwnFramesWhileTheMasterIsSilent) {
    std::uint64_t last = 4;
    for (int frame = 0; frame < 200; ++frame) {  // beyond the silence after which it joins again
        const std::uint64_t next = shown();
        EXPECT_TRUE(session_->isReckoned());
        ASSERT_GT(next, last);
        EXPECT_GE(next, 4U + DeadReckoning::kSilent + 1);
        last = next;
    }
}

TEST_F(ReckoningTest, takesUpTheFramesOfTheSameRun) {
    master_.show(5);
    EXPECT_EQ(nextFrame(), 5U);
    EXPECT_EQ(readying(5).get(), Release::Skip) << "the master does not release it";
    for (int frame = 0; frame < 5; ++frame) shown();
    auto led = showingUntilLed();
    master_.show(6);
    EXPECT_EQ(led.get(), 6U);
    EXPECT_FALSE(session_->renumbered());
    auto release = readying(6);
    std::optional<v1::Envelope> ready;
    do {
        ready = master_.hear(v1::Envelope::kReady);  // of frame 5 again and again, before
        ASSERT_TRUE(ready);
    } while (ready->ready().frame() == 5);
    EXPECT_EQ(ready->ready().frame(), 6U);
    EXPECT_FALSE(ready->ready().has_released_frame()) << "the master does not know that frame";
    master_.say(test::present(6, 0));
    EXPECT_EQ(release.get(), Release::Present);
}

TEST_F(ReckoningTest, joinsAnotherRunOfTheSameShowBesideItsFrames) {
    auto led = showingUntilLed();
    welcomeAs(kRun + 7, 2);
    master_.letIn({1});
    EXPECT_EQ(led.wait_for(milliseconds(200)), std::future_status::timeout);
    master_.show(0, {}, 2);  // before the node was a member
    master_.show(1, {}, 2);
    EXPECT_EQ(led.get(), 1U);
    EXPECT_EQ(session_->renumbered(), 2U);
}

TEST_F(ReckoningTest, goesOnWhereTheNextMasterDiesBeforeItLeads) {
    auto led = showingUntilLed();
    welcomeAs(kRun + 7, 2);
    master_.letIn({1});
    welcomeAs(kRun + 9, 3);
    master_.letIn({5});
    master_.show(5, {}, 3);
    EXPECT_EQ(led.get(), 5U);
    EXPECT_EQ(session_->renumbered(), 3U);
}

TEST_F(ReckoningTest, isToldWhyAnotherMasterRefusesIt) {
    auto led = showingUntilLed();
    master_.run = kRun + 7;
    ASSERT_TRUE(master_.hear(v1::Envelope::kHello));
    master_.say(test::refusal("another protocol"));
    EXPECT_FALSE(led.get());
    EXPECT_EQ(session_->interruption(), Release::Rejoin);
    auto join = joining();
    ASSERT_TRUE(master_.hear(v1::Envelope::kHello));
    master_.say(test::refusal("another protocol"));
    EXPECT_THAT(errorOf(std::move(join)), testing::HasSubstr("another protocol"));
}

TEST_F(ReckoningTest, goesOnAtOnceWhereTheMasterHandsOver) {
    v1::Envelope message = test::dismissed("the master changes");
    message.mutable_dismissed()->set_hands_over(true);
    master_.say(message);
    EXPECT_LT(shown(), 4U + DeadReckoning::kSilent + 1);
    EXPECT_TRUE(session_->isReckoned());
    EXPECT_TRUE(master_.hear(v1::Envelope::kHello)) << "it joins whoever is the master now";
}

TEST_F(ReckoningTest, joinsAnewWhereSomethingElseIsShown) {
    auto led = showingUntilLed();
    const v1::Welcome other = welcomeAs(kRun + 7, 1, 99);
    EXPECT_FALSE(led.get());
    EXPECT_EQ(session_->interruption(), Release::Rejoin);
    auto join = joining();
    ASSERT_TRUE(master_.hear(v1::Envelope::kHello));
    master_.say(test::welcome(other));
    EXPECT_EQ(join.get()->seed, 99U);
}

TEST_F(SessionTest, joinsAgainWhenTheMasterFallsSilent) {
    becomeMember(wire::Pace::Live, {0});
    EXPECT_FALSE(session_->nextFrame());  // nobody answers its pings any more
    EXPECT_EQ(session_->interruption(), Release::Rejoin);
}

TEST_F(SessionTest, stopEndsEveryWait) {
    auto join = joining();
    ASSERT_TRUE(master_.hear(v1::Envelope::kHello));
    session_->stop();
    EXPECT_FALSE(join.get());
    EXPECT_FALSE(session_->nextFrame());
    EXPECT_EQ(session_->readyThenWait({0}), Release::Quit);
    EXPECT_FALSE(session_->join());
}

TEST_F(SessionTest, stopEndsTheWaitForARelease) {
    becomeMember(wire::Pace::Live, {0});
    master_.show(0);
    EXPECT_EQ(nextFrame(), 0U);
    auto release = readying(0);
    ASSERT_TRUE(master_.hear(v1::Envelope::kReady));
    session_->stop();
    EXPECT_EQ(release.get(), Release::Quit);
    EXPECT_TRUE(master_.hear(v1::Envelope::kFarewell));
}

TEST_F(SessionTest, passesOnWhatItsKeysSay) {
    becomeMember(wire::Pace::Live, {0});
    session_->freeze(true);
    EXPECT_TRUE(master_.hear(v1::Envelope::kOrder)->order().show().freeze());
    session_->quit();
    EXPECT_EQ(master_.hear(v1::Envelope::kInput)->input().kind(), v1::INPUT_QUIT);
}

TEST_F(SessionTest, passesOnWhereFoodIsDropped) {
    becomeMember(wire::Pace::Live, {0});
    session_->dropFood({1, -6, -2.5F});
    const auto message = master_.hear(v1::Envelope::kInput);
    ASSERT_TRUE(message);
    EXPECT_EQ(message->input().kind(), v1::INPUT_DROP_FOOD);
    EXPECT_THAT(message->input().position(), testing::ElementsAre(1, -6, -2.5F));
}

TEST_F(SessionTest, asksForAMindAndKeepsTheLatestAnswer) {
    becomeMember(wire::Pace::Live, {0});
    EXPECT_FALSE(session_->latestMind());
    session_->askMind(7);
    EXPECT_EQ(master_.hear(v1::Envelope::kExplainRequest)->explain_request().fish(), 7U);
    master_.say(test::explanation(7, 60, 12, {"hungry"}));
    master_.say(test::explanation(7, 60, 27, {"sated"}));
    const auto isLatest = [&] {
        const auto mind = session_->latestMind();
        return mind && mind->lines == std::vector<std::string>{"sated"};
    };
    ASSERT_TRUE(test::comesTrue(isLatest));
    EXPECT_EQ(session_->latestMind()->fish, 7U);
}

TEST_F(SessionTest, noiseOnBothChannelsChangesNothing) {
    becomeMember(wire::Pace::Lockstep, {0});
    std::mt19937 random(9);
    for (int round = 0; round < 5; ++round) {
        for (int packet = 0; packet < 6; ++packet) {  // as many as the channels surely take
            net::ByteVector noise(random() % 200);
            for (std::byte& byte : noise) byte = static_cast<std::byte>(random());
            master_.sayNoise(noise);
        }
        ASSERT_TRUE(master_.hear(v1::Envelope::kPing));
    }
    master_.show(0);
    EXPECT_EQ(nextFrame(), 0U);
}

TEST_F(SessionTest, aMalformedAddressIsRefusedAtOnce) {
    EXPECT_THROW(static_cast<void>(connectSession("left", {"127.0.0.1"})), Error);
}

}  // namespace
}  // namespace aquarama::session
