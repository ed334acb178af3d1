// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/channel_picture.h"

#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "common/base/picture.h"
#include "common/place/place.h"
#include "common/wall/wall.h"
#include "render_node/show/controls.h"
#include "render_node/show/overlay.h"
#include "tests/render_node/show/fake_session.h"

namespace aquarama::show {
namespace {

constexpr glm::vec3 kFishPlace = place::kEyePosition + glm::vec3(0.2F, 0.1F, -3);

wire::StateFrame frameWithAFish(const motion::BodyFrame& body = {.position = kFishPlace}) {
    wire::StateFrame frame = emptySea();
    motion::MotionStates states;
    states.resize(1);
    motion::setBodyFrame(states, 0, body);
    frame.after = {motion::recordOf(states, 0)};
    return frame;
}

session::Admission admissionToTheWorld() {
    session::Admission admission = admissionTo(wire::Pattern::World);
    addScad(admission, 240);
    return admission;
}

// Where on the channel's picture a point of the world is seen, top left is (0, 0).
glm::dvec2 pixelOf(const config::Rig& rig, std::size_t channel, glm::dvec3 world) {
    const glm::dvec3 direction = world - glm::dvec3(place::kEyePosition);
    const double level = glm::length(glm::dvec2(direction.x, direction.z));
    return wall::Wall(rig)
        .channel(channel)
        .pixelOf(direction * (rig.screen.radiusMetres / level))
        .value_or(glm::dvec2(-1));
}

// Where both give half of the light, at the eye's height: u of the unrolled screen.
double seamBetween(const config::Rig& rig, std::size_t left, std::size_t right) {
    double best = 0;
    double u = 0;
    const wall::Wall wall(rig);
    for (int i = 0; i < 2000; ++i) {
        const glm::dvec3 point = wall.screen().at({i / 2000.0, 0.5}).value();
        const double both = wall.weight(left, point) * wall.weight(right, point);
        if (both <= best) continue;
        best = both;
        u = i / 2000.0;
    }
    return u;
}

// The scene takes seconds to grow, so that all share one.
class ChannelPictureTest : public testing::Test {
  protected:
    static constexpr std::size_t kLeft = 0;
    static constexpr std::size_t kMiddle = 1;
    struct Stage {
        std::unique_ptr<gl::Context> context = gl::makeOffscreenContext("auto", {480, 360});
        session::Admission admission = admissionToTheWorld();
        ChannelPicture picture{admission, kMiddle, config::QualityTier::Low};
        ChannelPicture left{admission, kLeft, config::QualityTier::Low};
        gl::Target target{GL_RGBA8, picture.sizePixels()};
        gl::Target deep{GL_RGBA16, picture.sizePixels()};
    };
    static void SetUpTestSuite() { stage = std::make_unique<Stage>(); }
    static void TearDownTestSuite() { stage.reset(); }

    static std::vector<std::uint8_t> shownOf(const wire::StateFrame& frame) {
        stage->picture.drawScene(frame, {});
        stage->picture.project(stage->target.framebuffer(), Encoding::Dithered8, {});
        return gl::readRgb<std::uint8_t>(stage->target);
    }
    static std::vector<std::uint8_t> shown(const Overlays& overlays,
                                           const std::optional<WatchedMind>& mind = {}) {
        stage->picture.drawScene(frameWithAFish(), overlays, mind);
        stage->picture.project(stage->target.framebuffer(), Encoding::Dithered8, overlays);
        return gl::readRgb<std::uint8_t>(stage->target);
    }
    static Light lightOfFrame(ChannelPicture& picture, const wire::StateFrame& frame) {
        picture.drawScene(frame, {});
        picture.project(stage->deep.framebuffer(), Encoding::Plain, {});
        const auto pixels = gl::readRgb<std::uint16_t>(stage->deep);
        return lightOf(Picture{picture.sizePixels(), 16, pixels});
    }
    // Where on the unrolled wall a channel shows the fish, in pixels of the panorama: the mean of
    // what it changes there.
    static glm::dvec2 shownPlace(ChannelPicture& picture,
                                 std::size_t channel,
                                 const wire::StateFrame& fish) {
        const config::Rig& rig = stage->admission.rig;
        const wall::Wall wall(rig);
        const wall::WarpMap warp = wall.warp(channel);
        const Light with = lightOfFrame(picture, fish);
        const Light without = lightOfFrame(picture, emptySea());
        glm::dvec2 sum(0);
        double total = 0;
        for (std::size_t i = 0; i < warp.pointAndWeight.size(); ++i) {
            const glm::dvec4 point(warp.pointAndWeight[i]);
            if (point.w < 0.02) continue;
            const glm::dvec3 change = glm::abs(with.rgb[i] - without.rgb[i]);
            const double share = (change.x + change.y + change.z) / point.w;
            sum +=
                share * wall.screen().unrolled(glm::dvec3(point)) * glm::dvec2(rig.panoramaPixels);
            total += share;
        }
        EXPECT_GT(total, 1) << "channel " << channel << " does not show the fish";
        return sum / total;
    }
    static inline std::unique_ptr<Stage> stage;
};

// But for the very first frame where two pictures share a context, which no node has: there a few
// codes differ by one.
TEST_F(ChannelPictureTest, theWorldIsAFunctionOfTheFrameAlone) {
    stage->picture.drawScene(frameWithAFish(), {});
    const auto first = shown({});
    wire::StateFrame other = frameWithAFish();
    other.tick = {500};
    stage->picture.drawScene(other, {});
    EXPECT_EQ(shown({}), first);
    EXPECT_GT(std::set<std::uint8_t>(first.begin(), first.end()).size(), 40U) << "a flat picture";
}

// From the mouse to the world and back to the light: through warp, eye and scene.
TEST_F(ChannelPictureTest, foodThatIsDroppedUnderTheMouseIsSeenUnderTheMouse) {
    const Pointing pointing(stage->admission.rig, kMiddle);
    for (const glm::vec2 mouse : {glm::vec2(240, 180), glm::vec2(120, 80), glm::vec2(350, 250)}) {
        const auto plain = shownOf(emptySea());
        wire::StateFrame fed = emptySea();
        const auto place = pointing.pinchAt(mouse, fed.eye);
        ASSERT_TRUE(place);
        fed.foodAfter = {wire::foodRecord(wire::FoodRecord::Kind::Pellet, *place, 1)};
        const auto shown = shownOf(fed);
        glm::vec2 sum(0);
        float count = 0;
        for (std::size_t i = 0; i < plain.size(); i += 3) {
            if (plain[i] == shown[i]) continue;
            const auto pixel = static_cast<int>(i / 3);
            sum += glm::vec2(pixel % 480, pixel / 480) + 0.5F;
            ++count;
        }
        ASSERT_GT(count, 2) << "no pellet is seen";
        EXPECT_LT(glm::distance(sum / count, mouse), 1.5F);
    }
}

TEST_F(ChannelPictureTest, theFishNearestToThePointerIsTheOneThatIsSeenThere) {
    wire::StateFrame frame = frameWithAFish();
    const wire::StateFrame other =
        frameWithAFish({.position = place::kEyePosition + glm::vec3(-0.7F, 0, -3)});
    frame.after.push_back(other.after.front());
    session::Admission two = stage->admission;
    two.school.push_back({.id = 18, .lengthMillimetres = 240});
    two.cast.front().fish = 2;
    two.world = true;
    ChannelPicture picture(two, kMiddle, config::QualityTier::Low);
    EXPECT_EQ(picture.fishNearest(emptySea(), {240, 180}), std::nullopt);
    EXPECT_EQ(picture.fishNearest(frame, glm::vec2(pixelOf(two.rig, kMiddle, kFishPlace))), 0U);
    EXPECT_EQ(picture.fishNearest(frame, {5, 180}), 1U);
}

TEST_F(ChannelPictureTest, aMindIsWrittenBesideItsFish) {
    const auto plain = shown({});
    const auto explained = shown({}, WatchedMind{0, {"SEES NOBODY"}});
    const auto changed = [&] {
        int count = 0;
        for (std::size_t i = 0; i < plain.size(); i += 3) {
            count += plain[i] != explained[i] ? 1 : 0;
        }
        return count;
    };
    EXPECT_GT(changed(), 300);
    EXPECT_EQ(plain, shown({}, WatchedMind{5, {"OF NO FISH OF THE SCHOOL"}}));
}

TEST_F(ChannelPictureTest, aFishsNumberStandsWhereTheWallShowsIt) {
    const auto plain = shown({});
    const auto numbered = shown({.fishIds = true});
    glm::dvec2 sum(0);
    double count = 0;
    for (std::size_t i = 0; i < plain.size(); i += 3) {
        if (plain[i] == numbered[i]) continue;
        const auto pixel = static_cast<int>(i / 3);
        sum += glm::dvec2(pixel % 480, pixel / 480) + 0.5;
        ++count;
    }
    ASSERT_GT(count, 60) << "no number is seen";
    ASSERT_LT(count, 1000) << "more than a number has changed";
    const glm::dvec2 expected = pixelOf(stage->admission.rig, kMiddle, kFishPlace);
    EXPECT_LT(glm::distance(sum / count, expected), 4);
}

TEST_F(ChannelPictureTest, gridMaskAndHelpAreSeen) {
    const auto plain = shown({});
    std::set<std::vector<std::uint8_t>> pictures{plain};
    pictures.insert(shown({.warpGrid = true}));
    pictures.insert(shown({.blendMask = true}));
    pictures.insert(shown({.help = true}));
    EXPECT_EQ(pictures.size(), 4U);
    EXPECT_EQ(shown({}), plain) << "an overlay leaves a trace";
}

// Fish that swim towards the wall, so that they are narrower than the overlap. Outlines are of
// whole pixels, hence the mean over several; what geometry alone does is held to a twentieth of a
// pixel by the test of the projection map.
TEST_F(ChannelPictureTest, neighboursShowAFishInTheirOverlapAtOnePlace) {
    const config::Rig& rig = stage->admission.rig;
    const double seam = seamBetween(rig, kLeft, kMiddle);
    glm::dvec2 sum(0);
    constexpr int kFish = 8;
    for (int i = 0; i < kFish; ++i) {
        const glm::dvec3 point = wall::makeSurface(rig)->at({seam, 0.3 + 0.05 * i}).value();
        const auto towardsTheWall = static_cast<float>(std::atan2(-point.z, point.x));
        const wire::StateFrame fish = frameWithAFish(
            {.position = place::kEyePosition + glm::vec3(glm::normalize(point) * 2.5),
             .rotation = glm::angleAxis(towardsTheWall, glm::vec3(0, 1, 0))});
        sum += shownPlace(stage->left, kLeft, fish) - shownPlace(stage->picture, kMiddle, fish);
    }
    EXPECT_LT(glm::length(sum / double{kFish}), 0.5);
}

// How many pixels a column of a picture goes without a change of code, in green and blue.
std::vector<int> flatRuns(const std::vector<std::uint8_t>& rgb, glm::ivec2 size) {
    std::vector<int> runs;
    for (int x = 4; x < size.x; x += 7)
        for (const int channel : {1, 2}) {
            int since = -1;
            for (int y = size.y / 2; y + 1 < size.y - size.y / 10; ++y) {
                const auto code = [&](int row) {
                    return rgb[static_cast<std::size_t>(3 * (row * size.x + x) + channel)];
                };
                if (code(y) == code(y + 1)) continue;
                if (since >= 0) runs.push_back(y - since);
                since = y;
            }
        }
    std::ranges::sort(runs);
    return runs;
}

// The lower half of open water is one dark gradient: without noise it would show steps of a code,
// which an eye sees there. In the mean of 8 x 8 pixels the noise is gone.
TEST_F(ChannelPictureTest, theGradientOfOpenWaterShowsNoBands) {
    session::Admission open = stage->admission;
    open.scene.place = config::PlaceKind::OpenSea;
    ChannelPicture picture(open, kMiddle, config::QualityTier::Low);
    wire::StateFrame frame = emptySea();
    frame.eye.positionMetres.y = -20.0F;
    picture.drawScene(frame, {});
    picture.project(stage->target.framebuffer(), Encoding::Dithered8, {});
    const auto codes = gl::readRgb<std::uint8_t>(stage->target);
    const std::vector<int> runs = flatRuns(codes, picture.sizePixels());
    ASSERT_GT(runs.size(), 1000U);
    EXPECT_LE(runs[runs.size() * 95 / 100], 6);
    picture.project(stage->deep.framebuffer(), Encoding::Plain, {});
    const auto exact = gl::readRgb<std::uint16_t>(stage->deep);
    const glm::ivec2 size = picture.sizePixels();
    int off = 0;
    int blocks = 0;
    for (int top = 0; top + 8 <= size.y; top += 8)
        for (int left = 0; left + 8 <= size.x; left += 8)
            for (int channel = 0; channel < 3; ++channel) {
                double difference = 0;
                for (int i = 0; i < 64; ++i) {
                    const auto at = static_cast<std::size_t>(
                        3 * ((top + i / 8) * size.x + left + i % 8) + channel);
                    difference += codes[at] - exact[at] / 257.0;
                }
                off += std::abs(difference / 64) > 0.3 ? 1 : 0;
                ++blocks;
            }
    EXPECT_LT(off, blocks / 500);
}

TEST(TextOverlay, drawsTheFontsDots) {
    const auto context = gl::makeOffscreenContext("auto", {64, 32});
    const gl::Target target(GL_RGBA8, {64, 32});
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
    glClearColor(0.5F, 0.5F, 0.5F, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    const std::vector<Label> labels{{{10, 5}, "R2"}};
    TextOverlay().draw(labels, target.framebuffer(), {64, 32}, 2);
    const auto pixels = gl::readRgb<std::uint8_t>(target);
    const auto at = [&](std::size_t x, std::size_t y) { return pixels[3 * (y * 64 + x)]; };
    const GlyphBits bits = glyphOf('2');
    for (std::size_t row = 0; row < kGlyphRows; ++row)
        for (std::size_t column = 0; column < kGlyphColumns; ++column) {
            const bool lit = (bits >> (row * kGlyphColumns + column) & 1U) != 0;
            // The second cell is 6 dots to the right; a margin of one dot above and to the left.
            const std::size_t x = 10 + 2 * (6 + 1 + column);
            const std::size_t y = 5 + 2 * (1 + row);
            EXPECT_EQ(at(x, y), lit ? 255 : 45) << column << ", " << row;
            EXPECT_EQ(at(x + 1, y + 1), at(x, y));
        }
    EXPECT_EQ(at(9, 10), 128) << "left of the box";
    EXPECT_EQ(at(10, 4), 128) << "above the box";
}

}  // namespace
}  // namespace aquarama::show
