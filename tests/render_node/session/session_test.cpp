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
#include "tests/render_node/session/listed_skins.h"
#include "tests/render_node/session/scripted_master.h"
#include "tests/support/await.h"
#include "tests/support/stage.h"
#include "tests/support/state_packet.h"

namespace aquarama::session {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

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
