// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/channel_show.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "common/base/log.h"
#include "common/base/picture.h"
#include "common/net/channels.h"
#include "common/wall/pattern.h"
#include "tests/render_node/show/fake_session.h"
#include "tests/render_node/show/reference.h"

namespace aquarama::show {
namespace {

namespace fs = std::filesystem;

constexpr double kGrey = 0.18;

class ChannelShowTest : public testing::Test {
  protected:
    void SetUp() override { fs::create_directories(folder_); }
    void TearDown() override { fs::remove_all(folder_); }

    [[nodiscard]] NodeOptions options(bool deep = false) const {
        NodeOptions chosen;
        chosen.channel = "middle";
        chosen.snapshotFolder = folder_;
        chosen.traceFolder = folder_;
        chosen.deep = deep;
        return chosen;
    }
    void show(FakeSession& session,
              const NodeOptions& chosen,
              wire::Pattern pattern = wire::Pattern::Grey) {
        Controls controls(session, true);
        ChannelShow(session, context_, controls, service_, chosen).run(admissionTo(pattern));
    }
    [[nodiscard]] std::vector<std::string> traceLines() const {
        std::istringstream text(fileText(folder_ + "/middle.csv"));
        std::vector<std::string> lines;
        for (std::string line; std::getline(text, line);) lines.push_back(line);
        return lines;
    }

    std::string folder_ = testing::TempDir() + "aquarama_channel_show_test";
    Events events_;
    CountingContext context_{events_, {480, 360}};
    machine::ServiceNotifier service_;
};

TEST_F(ChannelShowTest, everyFrameIsReadyBeforeItIsSwapped) {
    FakeSession session(
        events_,
        {{frameNumber(0), session::Release::Present}, {frameNumber(1), session::Release::Present}});
    show(session, options());
    EXPECT_EQ(events_, (Events{"prepared", "ready 0", "swap", "ready 1", "swap"}));
}

TEST_F(ChannelShowTest, aFrameThatTheWallPassedOverIsNotShown) {
    FakeSession session(
        events_,
        {{frameNumber(0), session::Release::Skip}, {frameNumber(1), session::Release::Present}});
    show(session, options());
    EXPECT_EQ(events_, (Events{"prepared", "ready 0", "ready 1", "swap"}));
    ASSERT_EQ(traceLines().size(), 2U);
    EXPECT_THAT(traceLines()[1], testing::StartsWith("1,"));
}

TEST_F(ChannelShowTest, aNodeThatWasDroppedJoinsAgain) {
    FakeSession session(events_,
                        {{frameNumber(0), session::Release::Present},
                         {frameNumber(1), session::Release::Rejoin},
                         {frameNumber(7), session::Release::Present}});
    session.rejoin_ = admissionTo(wire::Pattern::Grey);
    show(session, options());
    EXPECT_EQ(
        events_,
        (Events{"prepared", "ready 0", "swap", "ready 1", "join", "prepared", "ready 7", "swap"}));
}

TEST_F(ChannelShowTest, aNodeThatIsStoppedWhileItJoinsAgainEnds) {
    FakeSession session(events_, {{frameNumber(0), session::Release::Rejoin}});
    show(session, options());
    EXPECT_EQ(events_, (Events{"prepared", "ready 0", "join"}));
}

TEST_F(ChannelShowTest, tracesEachFrameInTheOrderOfTime) {
    FakeSession session(
        events_,
        {{frameNumber(3), session::Release::Present}, {frameNumber(4), session::Release::Present}});
    show(session, options());
    const auto lines = traceLines();
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_EQ(lines[0], "frame,state_ns,ready_ns,present_ns");
    std::uint64_t frame = 3;
    for (const std::string& line : {lines[1], lines[2]}) {
        std::istringstream cells(line);
        std::vector<std::uint64_t> values;
        for (std::string cell; std::getline(cells, cell, ',');) values.push_back(std::stoull(cell));
        ASSERT_EQ(values.size(), 4U);
        EXPECT_EQ(values[0], frame++);
        EXPECT_LT(values[1], values[2]);
        EXPECT_LE(values[2], values[3]);
    }
}

TEST_F(ChannelShowTest, theSnapshotIsTheGreyOfTheWall) {
    FakeSession session(events_, {{frameNumber(0), session::Release::Present}});
    show(session, options(/*deep=*/true));
    const Picture picture = readPng(folder_ + "/channel-middle.png");
    const config::Rig rig = wall::shippedRig("desk");
    const wall::WarpMap warp = wall::Wall(rig).warp(channelIndex(rig, "middle"));
    ASSERT_EQ(picture.sizePixels, warp.sizePixels);
    ASSERT_EQ(picture.bits, 16);
    for (std::size_t i = 0; i < warp.pointAndWeight.size(); ++i) {
        const double weight = static_cast<double>(warp.pointAndWeight[i].w);
        // Half floats hold 0.18 to one part in 4000.
        ASSERT_NEAR(picture.rgb[3 * i], 65535 * srgbOf(kGrey * weight), 10) << "weight " << weight;
    }
}

// The grid is built while grey is shown, and comes on with the first frame that says so; a frame of
// a look that was never built cannot be shown.
TEST_F(ChannelShowTest, theNextLookIsBuiltBesideTheFrames) {
    // Frames of grey until the next look is built, then one of the grid.
    class NextSession : public FakeSession {
      public:
        explicit NextSession(Events& events) : FakeSession(events, {}), events_{events} {}
        std::optional<wire::StateFrame> nextFrame() override {
            if (frame_.show.look == 1) return std::nullopt;
            const bool isBuilt = std::ranges::find(events_, "prepared look 1") != events_.end();
            frame_ = frameNumber(frame_.frame.value + 1,
                                 isBuilt ? wire::Pattern::Grid : wire::Pattern::Grey);
            frame_.show.look = isBuilt ? 1 : 0;
            return frame_;
        }
        session::Release readyThenWait(Frame) override { return session::Release::Present; }

      private:
        Events& events_;
        wire::StateFrame frame_;
    };
    FakeSession plain(events_, {{frameNumber(0, wire::Pattern::Grid), session::Release::Present}});
    show(plain, options(/*deep=*/true));
    const Picture grid = readPng(folder_ + "/channel-middle.png");
    NextSession session(events_);
    session.nextLook_ = admissionTo(wire::Pattern::Grid);
    session.nextLook_->look = 1;
    session.nextLook_->show = digestOf("another");
    show(session, options(/*deep=*/true));
    EXPECT_EQ(readPng(folder_ + "/channel-middle.png").rgb, grid.rgb);

    events_.clear();
    wire::StateFrame unknown = frameNumber(0);
    unknown.show.look = 9;
    FakeSession lost(events_, {{unknown, session::Release::Present}});
    show(lost, options());
    EXPECT_EQ(events_, (Events{"prepared", "join"}));
}

// Black to the last bit: no grain of the dither, no text.
TEST_F(ChannelShowTest, withoutLightAPictureIsBlackAndHalfTheLightIsHalf) {
    for (const float brightness : {0.0F, 0.5F}) {
        wire::StateFrame frame = frameNumber(0);
        frame.show.brightness = brightness;
        FakeSession session(events_, {{frame, session::Release::Present}});
        show(session, options(/*deep=*/true));
        const Picture picture = readPng(folder_ + "/channel-middle.png");
        const config::Rig rig = wall::shippedRig("desk");
        const wall::WarpMap warp = wall::Wall(rig).warp(channelIndex(rig, "middle"));
        for (std::size_t i = 0; i < warp.pointAndWeight.size(); ++i) {
            const double light = kGrey * double{brightness} * double{warp.pointAndWeight[i].w};
            ASSERT_NEAR(picture.rgb[3 * i], 65535 * srgbOf(light), brightness == 0 ? 0 : 10);
        }
    }
}

// Straight ahead of the picture's middle; a click goes where the window is clicked.
TEST_F(ChannelShowTest, dropsFoodAtAnArmsLengthBeforeTheEyeOfTheFrame) {
    wire::StateFrame frame = frameNumber(0);
    frame.eye.positionMetres = {4, -6, 0};
    FakeSession session(events_, {{frame, session::Release::Present}});
    Controls controls(session, true);
    controls.press('c');
    controls.click({0, 180});
    controls.click({480, 180});  // just outside
    ChannelShow(session, context_, controls, service_, options())
        .run(admissionTo(wire::Pattern::Grey));
    ASSERT_EQ(session.drops_.size(), 2U);
    EXPECT_LT(glm::distance(session.drops_[0], {4, -6, -2.5F}), 0.5F);
    EXPECT_LT(session.drops_[1].x, session.drops_[0].x - 0.2F);
    for (const glm::vec3 drop : session.drops_)
        EXPECT_NEAR(glm::distance(drop, frame.eye.positionMetres), 2.5F, 1e-3F);
}

// Without fish nobody is asked for, and the show goes on.
TEST_F(ChannelShowTest, aSeaWithoutFishHasNoMinds) {
    FakeSession session(events_, {{frameNumber(0), session::Release::Present}});
    Controls controls(session, true);
    controls.press('e');
    ChannelShow(session, context_, controls, service_, options())
        .run(admissionTo(wire::Pattern::Grey));
    EXPECT_EQ(events_, (Events{"prepared", "ready 0", "swap"}));
}

// What a pixel of the middle channel should show of the grid, by closed forms alone; 0 off the
// screen.
double gridOfTheWall(const wall::Wall& wall, glm::dvec2 pixel) {
    const auto point = wall.channel(1).pointOf(pixel, 0);
    return point ? wall::gridLight(*point) * wall.weight(1, *point) : 0;
}

// How far a picture is displaced from what it should be, by least squares: the reference's slope
// times the displacement explains the difference.
TEST_F(ChannelShowTest, theGridLiesOnTheWallToATenthOfAPixel) {
    FakeSession session(events_,
                        {{frameNumber(0, wire::Pattern::Grid), session::Release::Present}});
    show(session, options(/*deep=*/true), wire::Pattern::Grid);
    const Light light = lightOf(readPng(folder_ + "/channel-middle.png"));
    const wall::Wall wall(wall::shippedRig("desk"));
    glm::dvec2 slopeTimesDifference(0);
    glm::dvec2 slopeSquared(0);
    for (int y = 0; y < light.sizePixels.y; ++y)
        for (int x = 0; x < light.sizePixels.x; ++x) {
            const glm::dvec2 centre(x + 0.5, y + 0.5);
            const double difference =
                static_cast<double>(light.at(x, y).x) - gridOfTheWall(wall, centre);
            const glm::dvec2 slope(gridOfTheWall(wall, centre + glm::dvec2(0.5, 0)) -
                                       gridOfTheWall(wall, centre - glm::dvec2(0.5, 0)),
                                   gridOfTheWall(wall, centre + glm::dvec2(0, 0.5)) -
                                       gridOfTheWall(wall, centre - glm::dvec2(0, 0.5)));
            slopeTimesDifference += slope * difference;
            slopeSquared += slope * slope;
        }
    ASSERT_GT(slopeSquared.x, 1) << "no upright line is seen";
    ASSERT_GT(slopeSquared.y, 1) << "no level line is seen";
    EXPECT_LT(std::abs(slopeTimesDifference.x / slopeSquared.x), 0.1);
    EXPECT_LT(std::abs(slopeTimesDifference.y / slopeSquared.y), 0.1);
}

TEST_F(ChannelShowTest, aSnapshotWithNoFrameShownIsNone) {
    FakeSession session(events_, {{frameNumber(0), session::Release::Skip}});
    show(session, options());
    EXPECT_FALSE(fs::exists(folder_ + "/channel-middle.png"));
}

TEST_F(ChannelShowTest, theFramesOfAClipPassThroughASocketAsTheSnapshotHasThem) {
    NodeOptions chosen = options();
    chosen.filmPipe = folder_ + "/pipe";
    chosen.filmEvery = 2;
    std::vector<net::RawFrame> frames;
    const auto receiver = net::bindFrames(chosen.filmPipe);
    std::thread reader([&] {
        while (auto frame = receiver->receive()) frames.push_back(std::move(*frame));
    });
    FakeSession session(events_,
                        {{frameNumber(1), session::Release::Present},
                         {frameNumber(2), session::Release::Present},
                         {frameNumber(3), session::Release::Present},
                         {frameNumber(4), session::Release::Present}});
    show(session, chosen);
    reader.join();
    ASSERT_EQ(frames.size(), 2U);
    EXPECT_EQ(frames[0].frame, 2U);
    EXPECT_EQ(frames[1].frame, 4U);
    EXPECT_EQ(frames[1].rgb, readPng(folder_ + "/channel-middle.png").rgb);
}

TEST_F(ChannelShowTest, whatCannotBeWrittenIsSaidBeforeTheShow) {
    FakeSession session(events_, {});
    NodeOptions chosen = options();
    chosen.traceFolder = "/proc/nowhere";
    EXPECT_THROW(show(session, chosen), Error);
    EXPECT_TRUE(events_.empty());
}

TEST_F(ChannelShowTest, aLostContextEndsTheNodeBeforeItSaysThatItIsReady) {
    FakeSession session(
        events_,
        {{frameNumber(0), session::Release::Present}, {frameNumber(1), session::Release::Present}});
    context_.lostAfterSwaps_ = 1;
    try {
        show(session, options());
        FAIL() << "went on without a context";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("took its context away (a reset)"));
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    }
    EXPECT_EQ(std::ranges::count(events_, "ready 1"), 0);
    EXPECT_FALSE(fs::exists(folder_ + "/channel-middle.png"));
}

TEST_F(ChannelShowTest, aChannelThatTheRigLacksIsNamed) {
    FakeSession session(events_, {});
    NodeOptions chosen = options();
    chosen.channel = "ceiling";
    try {
        show(session, chosen);
        FAIL() << "a channel that is not there was taken";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr("ceiling"));
    }
}

}  // namespace
}  // namespace aquarama::show
