// SPDX-License-Identifier: Apache-2.0
// A standby over channels in memory: it follows a world, loses the thread, is refused, takes over.
#include "master/standby/follower.h"

#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "common/base/log.h"
#include "common/motion/motor.h"
#include "master/conductor/drawing_files.h"
#include "master/conductor/drawings.h"
#include "master/journal/journal.h"
#include "tests/support/memory_channels.h"
#include "tests/support/plain_skin.h"
#include "tests/support/synthetic_assets.h"

namespace aquarama::standby {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

simulation::Assets assetsOf(std::uint32_t seed) {
    simulation::Assets assets;
    assets.bytes = test::syntheticAssets(seed);
    assets.scene = config::parseScene(assets.bytes.scene, "scene");
    for (const wire::SpeciesAssets& species : assets.bytes.cast) {
        assets.scene.cast[assets.species.size()].fish = species.fish;
        assets.species.push_back(config::parseSpecies(species.text, species.file));
    }
    return assets;
}

// A master's end: its world, and what it sends.
class Master {
  public:
    Master(test::MemoryNet& net, const fs::path& journal, std::uint32_t seed = 1)
        : channels_{net.master()},
          world_{journal::makeJournalled(journal, assetsOf(seed), journal::TimeAway::LeftOut)} {
        show_.wanted.set_black(true);
        drawings_.enter({});
    }

    // Advances by a tick and sends what there is for the standby.
    void turn() {
        while (const auto from = channels_->receiveControl()) {
            const auto message = wire::decode(from->bytes);
            ASSERT_TRUE(message && (message->has_follow() || message->has_blob_request()));
            if (message->has_blob_request()) {
                giveChunk(from->peer, message->blob_request());
                continue;
            }
            asked_ = message->follow();
            peer_ = from->peer;
            feed_.hear(from->peer, message->follow(), net::monotonicNow());
        }
        if (feed_.takesBeginning()) world_->beginFollowed();
        visit();
        world_->advance();
        show_.drawings = drawings_.kept();
        feed_.turn(*world_, show_, net::monotonicNow());
    }
    // A drawing that a visitor has made; its number.
    std::uint32_t draw(std::uint16_t grey) { return draw(*test::plainSkin(grey)); }
    std::uint32_t draw(const std::vector<std::byte>& skin) {
        v1::OfferedDrawing offered;
        offered.set_species("clownfish");
        offered.set_skin(skin.data(), skin.size());
        std::uint32_t number = 0;
        EXPECT_NE(drawings_.offer(++requests_, offered, 1'800'000'000, number).outcome,
                  ask::Outcome::Refused);
        return number;
    }
    conductor::Drawings& drawings() { return drawings_; }
    // Blobs are not sent any more as they are.
    void spoilBlobs() { areSpoilt_ = true; }
    void say(v1::Envelope message) { sender_.say(peer_, std::move(message)); }
    // The next part of the stream that the standby has, with these entries.
    void sayEntries(const std::string& entries, std::uint64_t skipped = 0) {
        v1::Envelope message;
        message.mutable_journalled()->set_stream(asked_.stream());
        message.mutable_journalled()->set_part(asked_.taken() + skipped);
        message.mutable_journalled()->set_entries(entries);
        say(std::move(message));
    }
    [[nodiscard]] journal::JournalledWorld& world() { return *world_; }
    conductor::StandbyFeed& feed() { return feed_; }
    [[nodiscard]] const v1::Follow& asked() const { return asked_; }

  private:
    static config::DrawingRules rules() {
        config::DrawingRules rules;
        rules.species = {"clownfish"};
        return rules;
    }
    static net::Blob spoilt(std::vector<std::byte> blob) {
        blob.back() ^= std::byte{1};
        return std::make_shared<const std::vector<std::byte>>(std::move(blob));
    }
    void giveChunk(const net::PeerId& peer, const v1::BlobRequest& request) {
        const net::Blob blob = drawings_.blob(wire::digestIn(request.digest()));
        ASSERT_TRUE(blob);
        sender_.sayChunk(peer, request, areSpoilt_ ? spoilt(*blob) : blob);
    }
    void visit() {
        const std::uint64_t tick = world_->tick().value;
        if (tick % 17 == 5) world_->apply(world::DropFood{.position = {0.1F, -5, -4}});
        if (tick % 23 == 7) world_->apply(Steering{.ahead = static_cast<std::int8_t>(tick % 100)});
    }

    std::unique_ptr<net::MasterChannels> channels_;
    std::unique_ptr<journal::JournalledWorld> world_;
    conductor::Sender sender_{7, [this](const net::PeerId& peer, net::ByteView packet) {
                                  channels_->sendControl(peer, packet);
                              }};
    conductor::StandbyFeed feed_{true, sender_};
    conductor::FollowedShow show_{.scene = "tank", .wanted = {}, .kept = {}, .drawings = {}};
    conductor::Drawings drawings_{rules(), {}};
    std::uint64_t requests_ = 0;
    bool areSpoilt_ = false;
    v1::Follow asked_;
    net::PeerId peer_;
};

class FollowerTest : public testing::Test {
  protected:
    FollowerTest() : master_{net_, folder_ / "master"} {}
    ~FollowerTest() override { fs::remove_all(folder_); }

    Follower follower() {
        return Follower({.machine = "spare",
                         .connect = [this] { return net_.node(); },
                         .journal = folder_ / "spare",
                         .drawings = folder_ / "drawings",
                         .assets =
                             [this](const WantedWorld& wanted) {
                                 EXPECT_EQ(wanted.scene, "tank");
                                 const auto& school = assetsOf(1).bytes.cast.front();
                                 EXPECT_EQ(wanted.fish, school.fish - school.drawings);
                                 ++beginnings_;
                                 return assetsOf(seedOfFiles_);
                             }});
    }
    void turn(Follower& follower) {
        master_.turn();
        follower.turn();
    }
    bool getsInStep(Follower& follower) {
        for (int i = 0; i < 600 && master_.feed().inStep().empty(); ++i) turn(follower);
        return master_.feed().inStep() == "spare";
    }
    // Turns until the standby's disk has the drawings that the master has now.
    bool hasDrawings(Follower& follower) {
        for (int i = 0; i < 3000 && master_.feed().lacks(master_.drawings().kept()); ++i)
            turn(follower);
        return !master_.feed().lacks(master_.drawings().kept());
    }
    // What a master would find that starts on the standby's disk.
    [[nodiscard]] conductor::FoundDrawings kept() const {
        return conductor::DrawingFiles(folder_ / "drawings").read();
    }
    [[nodiscard]] std::size_t recordings() const {
        std::size_t count = 0;
        for (const auto& entry : fs::directory_iterator(folder_ / "spare"))
            count += entry.path().extension() == ".aqrec" ? 1U : 0U;
        return count;
    }

    fs::path folder_ = fs::temp_directory_path() / ("aquarama-standby-" + std::to_string(getpid()));
    test::MemoryNet net_;
    Master master_;
    std::uint32_t seedOfFiles_ = 1;  // of this machine's files, whatever was asked for
    int beginnings_ = 0;             // worlds that the standby tried to make
};

TEST_F(FollowerTest, takesOverTheSameWorldWithWhatIsAhead) {
    Follower spare = follower();
    ASSERT_TRUE(getsInStep(spare));
    for (int i = 0; i < 300; ++i) turn(spare);
    ASSERT_TRUE(spare.hasWorld());
    while (master_.world().tick().value % 17 != 6) turn(spare);  // an input is ahead
    for (int i = 0; i < 5; ++i) spare.turn();
    EXPECT_EQ(spare.tick(), master_.world().tick());
    const auto taken = spare.takeOver();
    EXPECT_TRUE(taken.show.wanted.black());
    EXPECT_EQ(taken.show.scene, "tank");
    while (master_.world().tick() < taken.world->tick()) master_.world().advance();
    while (taken.world->tick() < master_.world().tick()) taken.world->advance();
    for (int i = 0; i < 10; ++i) {
        EXPECT_EQ(taken.world->hash(), master_.world().hash()) << taken.world->tick().value;
        taken.world->advance();
        master_.world().advance();
    }
}

TEST_F(FollowerTest, keepsAJournalThatPlays) {
    Follower spare = follower();
    ASSERT_TRUE(getsInStep(spare));
    for (int i = 0; i < 200; ++i) turn(spare);
    static_cast<void>(spare.takeOver());
    EXPECT_EQ(recordings(), 1U);
    const auto last = journal::lastWorldIn(folder_ / "spare", assetsOf(1).bytes);
    ASSERT_TRUE(last);
    EXPECT_GT(last->recording.inputs.size(), 10U);
    EXPECT_GT(last->recording.checkpoints.size(), 1U);
}

TEST_F(FollowerTest, beginsAnewWhereItLostTheThread) {
    Follower spare = follower();
    ASSERT_TRUE(getsInStep(spare));
    // Of an input that is long past, whole.
    const wire::Packet past =
        wire::entryOf(simulation::recorded({1}, world::DropFood{.position = {0, -5, -4}}));
    const std::string late(reinterpret_cast<const char*>(past.data()), past.size());
    for (const auto& [entries, skipped] : {std::pair(std::string("no entry"), 0),
                                           {std::string(), 5},
                                           {std::string(90, '\0'), 0},
                                           {late + late + "x", 0}}) {
        for (int i = 0; i < 20; ++i) turn(spare);
        const std::uint64_t before = master_.asked().stream();
        for (int i = 0; i < 3; ++i) spare.turn();
        master_.turn();
        for (int i = 0; i < 3; ++i) spare.turn();
        master_.turn();
        master_.sayEntries(entries, static_cast<std::uint64_t>(skipped));
        for (int i = 0; i < 600 && master_.asked().stream() == before; ++i) turn(spare);
        EXPECT_NE(master_.asked().stream(), before);
        ASSERT_TRUE(getsInStep(spare));
    }
    for (int i = 0; i < 5; ++i) spare.turn();
    const auto taken = spare.takeOver();
    while (taken.world->tick() < master_.world().tick()) taken.world->advance();
    while (master_.world().tick() < taken.world->tick()) master_.world().advance();
    EXPECT_EQ(taken.world->hash(), master_.world().hash());
}

TEST(StandbyFeed, refusesByNameWhereABuildIsAnother) {
    v1::Follow other;
    other.set_machine("spare");
    other.set_major(wire::kProtocolMajor);
    other.set_build("0.0.1-other");
    std::string refused;
    const conductor::Sender sender{7, [&](const net::PeerId&, net::ByteView packet) {
                                       refused = wire::decode(packet)->refusal().reason();
                                   }};
    conductor::StandbyFeed feed{true, sender};
    feed.hear("peer", other, net::monotonicNow());
    EXPECT_THAT(refused, HasSubstr("0.0.1-other"));
    EXPECT_THAT(refused, HasSubstr("install the same version on both"));
    EXPECT_FALSE(feed.isThere());
    other.set_build(AQUARAMA_VERSION);
    feed.hear("peer", other, net::monotonicNow());
    EXPECT_THAT(refused, HasSubstr("moves fish to other places"));
}

TEST(StandbyFeed, answersARequestOnceHoweverOftenItIsSaid) {
    const conductor::Sender sender{7, [](const net::PeerId&, net::ByteView) {}};
    conductor::StandbyFeed feed{true, sender};
    v1::Follow follow;
    follow.set_machine("spare");
    follow.set_major(wire::kProtocolMajor);
    follow.set_build(AQUARAMA_VERSION);
    follow.set_motor_hash(motion::motorSelfTest());
    const auto begins = [&](std::uint64_t request, const net::PeerId& peer = "peer") {
        follow.set_request(request);
        feed.hear(peer, follow, net::monotonicNow());
        return feed.takesBeginning();
    };
    EXPECT_TRUE(begins(1));
    EXPECT_FALSE(begins(1)) << "it was said before the answer came";
    follow.set_stream(1);  // of before
    EXPECT_FALSE(begins(1));
    EXPECT_TRUE(begins(2));
    EXPECT_TRUE(begins(2, "the same on a fresh connection"));
}

TEST_F(FollowerTest, doesNotStandByWithOtherFiles) {
    seedOfFiles_ = 2;
    Follower spare = follower();
    std::string errors;
    setLogListener([&](Severity severity, const std::string& line) {
        if (severity == Severity::Error) errors += line + "\n";
    });
    const net::Moment begun = net::monotonicNow();
    for (int i = 0; i < 100; ++i) turn(spare);
    setLogListener({});
    EXPECT_FALSE(spare.hasWorld());
    EXPECT_LE(beginnings_, 1 + net::secondsIn(net::monotonicNow() - begun) / 5)
        << "it tries every five seconds";
    EXPECT_THAT(errors, HasSubstr("spare does not stand by: scene tank"));
    seedOfFiles_ = 1;  // they were put right
    const net::Moment end = net::monotonicNow() + std::chrono::seconds(60);
    while (!spare.hasWorld() && net::monotonicNow() < end) turn(spare);
    EXPECT_TRUE(spare.hasWorld()) << "it tries again after a pause";
}

TEST_F(FollowerTest, keepsTheDrawingsAsTheMasterHasThem) {
    const std::uint32_t first = master_.draw(200);
    Follower spare = follower();
    ASSERT_TRUE(getsInStep(spare));
    const std::uint32_t second = master_.draw(90);
    ASSERT_TRUE(hasDrawings(spare));
    conductor::FoundDrawings found = kept();
    ASSERT_EQ(found.drawings.size(), 2U);
    EXPECT_EQ(found.lastNumber, second);
    EXPECT_EQ(found.drawings[0].number, first);
    EXPECT_EQ(*found.drawings[0].skin, *test::plainSkin(200));
    EXPECT_EQ(*found.drawings[1].skin, *test::plainSkin(90));
    EXPECT_FALSE(found.drawings[1].isLetIn);

    v1::Moderation decision;
    decision.set_number(second);
    decision.set_verdict(v1::Moderation::LET_IN);
    static_cast<void>(master_.drawings().decide("the crew", 100, decision));
    decision.set_number(first);
    decision.set_verdict(v1::Moderation::TAKE_DOWN);
    static_cast<void>(master_.drawings().decide("the crew", 101, decision));
    EXPECT_TRUE(master_.feed().lacks(master_.drawings().kept())) << "it does not know yet";
    ASSERT_TRUE(hasDrawings(spare));
    found = kept();
    ASSERT_EQ(found.drawings.size(), 1U);
    EXPECT_TRUE(found.drawings[0].isLetIn);
    EXPECT_FALSE(fs::exists(folder_ / "drawings" / (std::to_string(first) + ".png")));
}

// Noise that no compression makes smaller: a skin in several parts.
TEST_F(FollowerTest, keepsALargeDrawing) {
    std::mt19937 random{3};
    PngPicture noise{.sizePixels = body::kSideTexels,
                     .codes = std::vector<std::uint16_t>(
                         3 * static_cast<std::size_t>(body::kSideTexels.x * body::kSideTexels.y))};
    for (std::uint16_t& code : noise.codes) code = static_cast<std::uint16_t>(random() & 255U);
    const auto skin = encodePng(noise, PngMeaning::Srgb);
    ASSERT_GT(skin.size(), 2 * wire::kBlobChunkBytes);
    master_.draw(skin);
    Follower spare = follower();
    ASSERT_TRUE(getsInStep(spare));
    ASSERT_TRUE(hasDrawings(spare));
    ASSERT_EQ(kept().drawings.size(), 1U);
    EXPECT_EQ(*kept().drawings[0].skin, skin);
}

TEST_F(FollowerTest, keepsTheDrawingsThatItHasWhereTheMastersCannotBeRead) {
    Follower spare = follower();
    master_.draw(200);
    ASSERT_TRUE(getsInStep(spare));
    ASSERT_TRUE(hasDrawings(spare));
    std::string errors;
    setLogListener([&](Severity severity, const std::string& line) {
        if (severity == Severity::Error) errors += line + "\n";
    });
    master_.spoilBlobs();
    master_.draw(90);
    for (int i = 0; i < 300 && errors.empty(); ++i) turn(spare);
    for (int i = 0; i < 50; ++i) turn(spare);
    setLogListener({});
    EXPECT_EQ(errors,
              "the master's drawings cannot be read, and are not kept here; restart the master\n");
    EXPECT_TRUE(master_.feed().lacks(master_.drawings().kept()));
    EXPECT_EQ(kept().drawings.size(), 1U);
    EXPECT_EQ(master_.feed().inStep(), "spare") << "the world is not held up by it";
}

TEST_F(FollowerTest, doesNotTakeOverAShowThatHasEnded) {
    Follower spare = follower();
    ASSERT_TRUE(getsInStep(spare));
    master_.feed().sayFarewell();
    for (int i = 0; i < 50 && spare.hasWorld(); ++i) spare.turn();
    EXPECT_FALSE(spare.hasWorld());
}

}  // namespace
}  // namespace aquarama::standby
