// SPDX-License-Identifier: Apache-2.0
// A poster: drawn in tiles it is what one piece shows, and the wall's own panorama is its mean.
#include "render_node/show/poster.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "calibration/compose/compose.h"
#include "common/place/place.h"
#include "common/wall/wall.h"
#include "render_node/gl/context.h"
#include "render_node/shaders/shader_interface.h"
#include "tests/render_node/show/fake_session.h"

namespace aquarama::show {
namespace {

constexpr std::size_t kMiddle = 1;

// The desk at half its size, with a fish before the middle channel.
session::Admission admissionToTheReef() {
    session::Admission admission = admissionTo(wire::Pattern::World);
    halvePictures(admission.rig);
    admission.rig.panoramaPixels /= 2;
    addScad(admission, 300);
    return admission;
}

wire::StateFrame frameWithAFish() {
    wire::StateFrame frame = frameNumber(1);
    frame.eye.positionMetres = place::kEyePosition;
    motion::MotionStates states;
    states.resize(1);
    motion::setBodyFrame(states, 0, {.position = place::kEyePosition + glm::vec3(0.2F, 0.1F, -2)});
    frame.after = {motion::recordOf(states, 0)};
    return frame;
}

// The scene takes seconds to grow, so that all share one. With softening and bloom.
class PosterTest : public testing::Test {
  protected:
    static constexpr config::QualityTier kTier = config::QualityTier::Medium;
    struct Stage {
        std::unique_ptr<gl::Context> context = gl::makeOffscreenContext("mesa", {16, 16});
        session::Admission admission = admissionToTheReef();
        std::shared_ptr<const wall::Wall> wall = std::make_shared<const wall::Wall>(admission.rig);
        ChannelPicture picture{admission, kMiddle, kTier, wall};
        Light shown;  // of the middle channel
        std::optional<Light> fine;
    };
    static void SetUpTestSuite() {
        stage = std::make_unique<Stage>();
        stage->picture.drawScene(frameWithAFish(), {});
        stage->shown = lightOf(takePicture(stage->picture, PictureBits::Deep16, Shown::Display));
    }
    static void TearDownTestSuite() { stage.reset(); }

    static Poster poster(int scale, int mostTilePixels = 2048) {
        return {*stage->wall,
                stage->picture.drawnWorld().value(),
                {.panoramaPixels = stage->admission.rig.panoramaPixels,
                 .scale = scale,
                 .quality = kTier,
                 .mostTilePixels = mostTilePixels}};
    }
    // All rows of a poster at scale 2.
    static const Light& twiceAsFine() {
        const int rows = 2 * stage->admission.rig.panoramaPixels.y;
        if (!stage->fine) stage->fine = poster(2).rows(0, rows);
        return *stage->fine;
    }
    static inline std::unique_ptr<Stage> stage;
};

int codesApart(const glm::vec3& one, const glm::vec3& other) {
    int most = 0;
    for (int c = 0; c < 3; ++c)
        most = std::max(
            most,
            static_cast<int>(std::lround(255 * std::abs(srgbFromLinear(double{one[c]}) -
                                                        srgbFromLinear(double{other[c]})))));
    return most;
}

// The mean of squares of so many pixels a side.
Light boxed(const Light& fine, int side) {
    Light coarse = darkness(fine.sizePixels / side);
    for (int y = 0; y < coarse.sizePixels.y * side; ++y)
        for (int x = 0; x < coarse.sizePixels.x * side; ++x)
            coarse.at(x / side, y / side) += fine.at(x, y) / static_cast<float>(side * side);
    return coarse;
}

TEST_F(PosterTest, tilesAreThePictureThatOnePieceIs) {
    constexpr int kFirst = 390;
    constexpr int kRows = 100;
    const Light whole = poster(3).rows(kFirst, kRows);
    const Light tiled = poster(3, 384).rows(kFirst, kRows);
    ASSERT_EQ(tiled.sizePixels, whole.sizePixels);
    std::size_t apart = 0;
    std::vector<int> ofColumn(static_cast<std::size_t>(whole.sizePixels.x), 0);
    for (int y = 0; y < kRows; ++y)
        for (int x = 0; x < whole.sizePixels.x; ++x) {
            if (codesApart(whole.at(x, y), tiled.at(x, y)) <= 1) continue;
            ++apart;
            ++ofColumn[static_cast<std::size_t>(x)];
        }
    // An edge of a triangle may fall to the other side of the middle of a pixel.
    EXPECT_LT(static_cast<double>(apart), 1e-3 * static_cast<double>(whole.rgb.size()));
    EXPECT_LT(*std::ranges::max_element(ofColumn), kRows / 20) << "a seam";
}

TEST_F(PosterTest, aBandIsTheSameRowsOfALargerOne) {
    const Poster drawn = poster(1);
    const glm::ivec2 size = drawn.sizePixels();
    const Light more = drawn.rows(size.y / 2 - 30, 60);
    const Light band = drawn.rows(size.y / 2, 20);
    for (int x = 0; x < size.x; ++x) ASSERT_LE(codesApart(band.at(x, 7), more.at(x, 37)), 1) << x;
}

// Where the middle channel alone lights the wall.
TEST_F(PosterTest, itsMeanIsThePanoramaOfTheWall) {
    const config::Rig& rig = stage->admission.rig;
    std::vector<Light> channels(rig.channels.size(), darkness(stage->picture.sizePixels()));
    channels[kMiddle] = stage->shown;
    const Light shown = compose::composePanorama(rig, channels);
    const Light fine = boxed(twiceAsFine(), 2);
    ASSERT_EQ(fine.sizePixels, shown.sizePixels);
    const PanoramaShare share = panoramaShares(*stage->wall, rig.panoramaPixels)[kMiddle];
    constexpr int kBlock = 20;
    double worst = 0;
    double unlike = 0;
    int blocks = 0;
    for (int y = 0; y + kBlock <= shown.sizePixels.y; y += kBlock)
        for (int x = 0; x + kBlock <= shown.sizePixels.x; x += kBlock) {
            if (share.at({x, y + 0.5}) < 1 || share.at({x + kBlock, y + 0.5}) < 1) continue;
            glm::dvec3 one(0);
            glm::dvec3 other(0);
            for (int i = 0; i < kBlock * kBlock; ++i) {
                one += shown.at(x + i % kBlock, y + i / kBlock);
                other += fine.at(x + i % kBlock, y + i / kBlock);
            }
            const double change = glm::length(one - other) / glm::length(one);
            worst = std::max(worst, change);
            unlike += change;
            ++blocks;
        }
    ASSERT_GT(blocks, 50);
    EXPECT_LT(worst, 0.25);
    EXPECT_LT(unlike / blocks, 0.03);
}

// The mean difference of neighbours in a row.
double fineness(const Light& light) {
    double sum = 0;
    for (int y = 0; y < light.sizePixels.y; ++y)
        for (int x = 1; x < light.sizePixels.x; ++x)
            sum += std::abs(luminance(light.at(x, y)) - luminance(light.at(x - 1, y)));
    return sum / static_cast<double>(light.rgb.size());
}

// Of a picture with every pixel enlarged to two by two, neighbours differ half as much as of the
// picture itself.
TEST_F(PosterTest, itIsDrawnAnewNotEnlarged) {
    const Light& fine = twiceAsFine();
    EXPECT_GT(fineness(fine), 0.7 * fineness(boxed(fine, 2)));
}

// The shares of all channels sum to one, so that the poster is as bright where they overlap.
TEST(PosterPlanTest, theSharesSumToOneEverywhere) {
    const config::Rig rig = wall::shippedRig("desk");
    const auto shares = panoramaShares(wall::Wall(rig), rig.panoramaPixels);
    for (int y = 0; y < rig.panoramaPixels.y; y += 7)
        for (int x = 0; x < rig.panoramaPixels.x; ++x) {
            float sum = 0;
            for (const PanoramaShare& share : shares) sum += share.at({x + 0.25, y + 0.75});
            ASSERT_NEAR(sum, 1, 1e-3) << x << ", " << y;
        }
}

// Softening and bloom read no place outside of a tile's part, but where the whole picture ends.
TEST(PosterPlanTest, everyTileHasTheMarginOfThePasses) {
    const config::Rig rig = wall::shippedRig("desk");
    const wall::Wall wall(rig);
    auto shares = panoramaShares(wall, rig.panoramaPixels);
    const PosterChannel channel(wall,
                                kMiddle,
                                std::move(shares[kMiddle]),
                                {.panoramaPixels = rig.panoramaPixels, .scale = 2});
    const wall::ChannelFrustum& frustum = channel.frustum();
    const double reach =
        double{shaders::kPostReach} * channel.picturePixels().x / (frustum.right - frustum.left);
    const scene::PixelArea lit = channel.area();
    for (int x = 0; x + 40 <= lit.size.x; x += 40) {
        const auto tile = channel.tile({lit.corner + glm::ivec2(x, lit.size.y / 2), {40, 40}});
        ASSERT_TRUE(tile.has_value()) << x;
        const int end = tile->part.corner.x + tile->part.size.x;
        for (const glm::vec4& place : tile->map.placeAndWeight) {
            if (place.z <= 0) continue;
            const double pixel = double{place.x} * tile->part.size.x;
            ASSERT_TRUE(tile->part.corner.x == 0 || pixel >= reach) << x;
            ASSERT_TRUE(end == channel.picturePixels().x || pixel <= tile->part.size.x - reach)
                << x;
        }
    }
}

}  // namespace
}  // namespace aquarama::show
