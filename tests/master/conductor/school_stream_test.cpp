// SPDX-License-Identifier: Apache-2.0
// The stream of the fish from a living world to a node: the node has every fish to the bit,
// whatever visitors do, and finds it again where frames are lost, or where a bit of its memory is
// wrong.
#include "master/conductor/school_stream.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "common/net/blob.h"
#include "common/school/keyframe.h"
#include "common/wire/messages.h"
#include "master/simulation/living_world.h"
#include "render_node/session/school_follower.h"
#include "tests/master/world/lively_worlds.h"
#include "tests/master/world/node_motion.h"

namespace aquarama::conductor {
namespace {

using std::chrono::milliseconds;

constexpr net::Duration kFrame = milliseconds(16);

// A living world, its stream, and a node that follows it. What the node asks is answered at once.
class Followed {
  public:
    explicit Followed(const std::string& scene)
        : options_(world::optionsFor(scene)),
          world_(options_),
          follower_([this](v1::Envelope message) { answer(message); }) {
        stream_.begin(world_.recordedRates());
        follower_.use(1, world::nodeMotion(options_, world_.world()));
        last_ = world_.snapshot();
        stream_.add(last_);
        remember();
    }

    // One tick of the world, and what visitors do in it.
    void advance() {
        world::doAt(world_, last_.fish.size());
        world_.advance();
        last_ = world_.snapshot();
        stream_.add(last_);
        remember();
    }
    // A frame between the last two ticks, as it is sent.
    wire::CodedState frame() {
        wire::CodedState coded;
        coded.frame.frame = {++frames_};
        coded.frame.tick = last_.tick;
        coded.frame.fraction = 0.5F;
        coded.frame.show.look = 1;
        coded.school = stream_.upTo(last_.tick);
        return coded;
    }
    void send(wire::CodedState coded) {
        now_ += kFrame;
        follower_.take(std::move(coded), now_);
        follower_.turn(now_);
    }
    // Whether the frames that the node has now show the fish as the world had them. Nothing: it has
    // none.
    std::optional<bool> isSame() {
        std::optional<bool> isSame;
        while (const auto next = follower_.next()) {
            const std::uint64_t tick = next->state.tick.value;
            isSame = isSame.value_or(true) && next->state.after == lived_.at(tick) &&
                     next->state.before == lived_.at(tick - 1);
        }
        return isSame;
    }
    session::SchoolFollower& follower() { return follower_; }
    [[nodiscard]] std::size_t fish() const { return last_.fish.size(); }
    [[nodiscard]] int keyframes() const { return keyframes_; }
    [[nodiscard]] std::size_t placed() const { return last_.placed.size(); }

  private:
    void remember() {
        lived_[last_.tick.value] = last_.fish;
        lived_.erase(last_.tick.value - 300);
    }
    void answer(const v1::Envelope& message) {
        if (message.has_keyframe_request()) {
            ++keyframes_;
            v1::Keyframe keyframe;
            keyframe.set_digest(wire::bytesOf(*stream_.keyframe()));
            return follower_.take(keyframe);
        }
        ASSERT_TRUE(message.has_blob_request());
        const v1::BlobRequest& request = message.blob_request();
        const net::Blob blob = stream_.blob(wire::digestIn(request.digest()));
        ASSERT_TRUE(blob);
        const auto content = net::chunkAt(*blob, request.offset(), wire::kBlobChunkBytes);
        v1::BlobChunk chunk;
        chunk.set_digest(request.digest());
        chunk.set_offset(request.offset());
        chunk.set_total(blob->size());
        chunk.set_content(content.data(), content.size());
        follower_.take(chunk);
    }

    world::WorldOptions options_;
    simulation::LivingWorld world_;
    SchoolStream stream_;
    session::SchoolFollower follower_;
    Snapshot last_;
    std::map<std::uint64_t, std::vector<motion::FishRecord>> lived_;  // by tick
    std::uint64_t frames_ = 0;
    net::Moment now_{std::chrono::seconds(100)};
    int keyframes_ = 0;
};

TEST(SchoolStream, aNodeHasTheFishOfEveryTickInEveryScene) {
    std::size_t placed = 0;
    for (const std::string& scene : world::allScenes()) {
        Followed followed(scene);
        for (int tick = 0; tick < 400; ++tick) {
            followed.advance();
            followed.send(followed.frame());
            ASSERT_EQ(followed.isSame(), true) << scene << " at tick " << tick;
            placed += followed.placed();
        }
        EXPECT_EQ(followed.follower().mismatches(), 0U) << scene;
        EXPECT_EQ(followed.keyframes(), 0) << scene << ": the first frame brings all";
    }
    EXPECT_GT(placed, 20U) << "fish come, are eaten, and wear drawings";
}

// Of six frames one is lost, and now and then the node is another one that has just started.
TEST(SchoolStream, aNodeThatHasLostTheStreamFindsItAgain) {
    std::mt19937 random(20261127);
    Followed followed("reef_1998");
    const auto motion = [] {
        const world::WorldOptions options = world::optionsFor("reef_1998");
        return world::nodeMotion(options, world::World(options));
    }();
    int shown = 0;
    int sinceShown = 0;
    for (int tick = 0; tick < 3000; ++tick) {
        followed.advance();
        if (random() % 4 == 0) continue;  // the wall is slower than the world
        wire::CodedState frame = followed.frame();
        if (random() % 300 == 0) {
            followed.follower().forget();
            followed.follower().use(1, motion);
        }
        if (random() % 6 == 0) continue;
        followed.send(std::move(frame));
        const auto isSame = followed.isSame();
        EXPECT_NE(isSame, false) << "at tick " << tick;
        shown += isSame ? 1 : 0;
        sinceShown = isSame ? 0 : sinceShown + 1;
        ASSERT_LT(sinceShown, 40) << "at tick " << tick;  // requests are 16 frames apart
    }
    EXPECT_GT(shown, 600);
    EXPECT_GT(followed.keyframes(), 50);
    EXPECT_EQ(followed.follower().mismatches(), 0U);
}

TEST(SchoolStream, aWrongBitIsNoticedWithinASecondAndHealed) {
    for (const std::size_t wrong : {0U, 1U, 2U, 3U, 4U}) {
        Followed followed("reef_1998");
        followed.advance();
        wire::CodedState frame = followed.frame();
        const std::size_t fish = followed.fish() / 2;
        auto keyframe = school::decodeKeyframe(frame.school.keyframe, followed.fish());
        ASSERT_TRUE(keyframe);
        school::SchoolState& school = keyframe->school;
        if (wrong == 0) school.states.x[fish] ^= 1;
        if (wrong == 1) school.states.speed[fish] ^= 1 << 12U;
        if (wrong == 2) school.states.gaze[fish] ^= 4U;
        if (wrong == 3) school.commands.pitch[fish] ^= 1024;
        if (wrong == 4) school.skins[fish] ^= 1U;
        std::vector<motion::FishRecord> records;
        school.records(records);
        frame.school.keyframe =
            school::encodeKeyframe(school.tick, records, school.commands, keyframe->memory);
        followed.send(std::move(frame));
        std::optional<bool> isSame;
        for (int frames = 0; frames < 60; ++frames) {
            followed.advance();
            followed.send(followed.frame());
            isSame = followed.isSame();
        }
        EXPECT_EQ(isSame, true) << wrong;
        // What is only seen may have been right again before.
        if (wrong != 2) {
            EXPECT_EQ(followed.follower().mismatches(), 1U) << wrong;
        }
    }
}

TEST(SchoolStream, anotherWorldBeginsAnew) {
    SchoolStream stream;
    Snapshot snapshot{
        .tick = {5}, .eye = {}, .fish = std::vector<motion::FishRecord>(3), .food = {}};
    stream.begin({});
    stream.add(snapshot);
    const wire::SchoolPart first = stream.upTo({5});
    EXPECT_FALSE(first.keyframe.empty());
    EXPECT_TRUE(stream.upTo({5}).keyframe.empty()) << "nodes have it";
    stream.begin({});
    EXPECT_FALSE(stream.keyframe()) << "there is no tick yet";
    snapshot.tick = {0};
    stream.add(snapshot);
    const wire::SchoolPart next = stream.upTo({0});
    EXPECT_NE(next.stream, first.stream);
    EXPECT_FALSE(next.keyframe.empty());
}

// Nobody drew for a while: what nodes lack is more than is kept.
TEST(SchoolStream, afterALongWhileAFrameBringsAll) {
    SchoolStream stream;
    Snapshot snapshot{
        .tick = {}, .eye = {}, .fish = std::vector<motion::FishRecord>(3), .food = {}};
    stream.begin({});
    for (std::uint64_t tick = 0; tick <= 1000; ++tick) {
        snapshot.tick = {tick};
        stream.add(snapshot);
        if (tick == 20) {
            EXPECT_FALSE(stream.upTo({tick}).keyframe.empty());
        }
        if (tick == 30) {
            EXPECT_EQ(stream.upTo({tick}).steps.size(), 10U);
        }
    }
    const wire::SchoolPart part = stream.upTo({1000});
    EXPECT_FALSE(part.keyframe.empty());
    EXPECT_LT(part.steps.size(), 130U);
    EXPECT_EQ(part.steps.back().tick, Tick{1000});
}

}  // namespace
}  // namespace aquarama::conductor
