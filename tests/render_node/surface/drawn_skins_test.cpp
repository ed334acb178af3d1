// SPDX-License-Identifier: Apache-2.0
// Fish that wear what visitors have painted, in the light of the scene: where their colours lie, at
// every level of detail, and that nobody else changes.
#include "render_node/surface/drawn_skins.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <epoxy/gl.h>
#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "common/base/picture.h"
#include "common/body/side_skin.h"
#include "common/body/side_view.h"
#include "common/place/place.h"
#include "render_node/gl/context.h"
#include "render_node/scene/scene.h"
#include "render_node/surface/visibility.h"
#include "tests/render_node/surface/test_fish.h"
#include "tests/support/cast.h"

namespace aquarama::surface {
namespace {

constexpr glm::ivec2 kSize{512, 256};
constexpr float kLength = 0.24F, kAway = 0.7F, kTangent = 0.2F;
constexpr int kBetween = 400;  // column between the two fish
constexpr float kPixelsAUnit = static_cast<float>(kSize.y) / (2 * kTangent);

// A drawing of codes that depend on the texel.
template <class CodesAt>
std::shared_ptr<const body::SideSkin> drawing(const CodesAt& codesAt) {
    PngPicture picture{.sizePixels = body::kSideTexels, .codes = {}};
    for (int y = 0; y < picture.sizePixels.y; ++y)
        for (int x = 0; x < picture.sizePixels.x; ++x) {
            const glm::ivec3 codes = codesAt(glm::ivec2{x, y});
            for (int c = 0; c < 3; ++c)
                picture.codes.push_back(static_cast<std::uint16_t>(codes[c]));
        }
    return std::make_shared<const body::SideSkin>(
        body::sideSkinOf(encodePng(picture, PngMeaning::Srgb), "a drawing"));
}

constexpr glm::ivec3 kRed{220, 20, 30}, kGreen{30, 170, 40}, kBlue{30, 40, 220},
    kYellow{250, 220, 20};

std::shared_ptr<const body::SideSkin> plain(glm::ivec3 codes) {
    return drawing([=](glm::ivec2) { return codes; });
}

// Degrees: 0 red, 120 green, 240 blue.
float hueOf(glm::vec3 c) {
    const float hue = std::atan2(std::sqrt(3.0F) * (c.g - c.b), 2 * c.r - c.g - c.b);
    const float degrees = glm::degrees(hue);
    return degrees < 0 ? degrees + 360 : degrees;
}

struct Picture {
    std::vector<glm::vec4> pixels;

    [[nodiscard]] glm::vec3 at(int x, int y) const {
        return pixels.at(static_cast<std::size_t>(y * kSize.x + x));
    }
    // Mean of 5 x 5 pixels about a place of the fish in the middle.
    [[nodiscard]] glm::vec3 onFish(float s, float y, bool showsLeftSide) const {
        const float x = (s - test::kCentreStation) * kLength * (showsLeftSide ? 1.0F : -1.0F);
        const glm::ivec2 centre =
            kSize / 2 + glm::ivec2(glm::round(kPixelsAUnit / kAway * glm::vec2{x, y * kLength}));
        glm::vec3 sum{};
        for (int dy = -2; dy <= 2; ++dy)
            for (int dx = -2; dx <= 2; ++dx) sum += at(centre.x + dx, centre.y + dy);
        return sum / 25.0F;
    }
};

scene::View viewOf(float shift = 0.0F, float finer = 1.0F) {
    constexpr float kNear = 0.05F;
    scene::View view;
    view.sizePixels = kSize;
    view.cameraFromWorld = glm::lookAt(
        place::kEyePosition, place::kEyePosition + glm::vec3{0, 0, -1}, glm::vec3{0, 1, 0});
    view.clipFromCamera = glm::mat4{0.0F};
    view.clipFromCamera[0][0] =
        static_cast<float>(kSize.y) / static_cast<float>(kSize.x) / kTangent;
    view.clipFromCamera[1][1] = 1.0F / kTangent;
    view.clipFromCamera[2][0] = shift;
    view.clipFromCamera[2][3] = -1.0F;
    view.clipFromCamera[3][2] = kNear;
    view.finer = finer;
    return view;
}

// Pixels of the wall that the fish fills, in the middle of each level that low quality has.
constexpr std::array<float, 6> kPixelsAtLevel{2.0F, 3.2F, 12.0F, 45.0F, 120.0F, 400.0F};
constexpr float kFewestPixels = 1.0F;

// Two clownfish in the open sea: the first in the middle of the picture, the second to the right.
class DrawnSkinsTest : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        context() = gl::makeOffscreenContext("mesa", kSize);
        const config::Species species = test::castMember("clownfish");
        const body::FishBody body = body::makeBody(species);
        const std::vector<SchoolSpecies> cast{
            {.body = body,
             .skin = body::skinOf(species),
             .repertoire = test::swaying(body, 0.0F),
             .fish = {{.id = 3, .lengthMillimetres = 240}, {.id = 8, .lengthMillimetres = 240}},
             .takesDrawings = true}};
        scene() = std::make_unique<scene::SceneRenderer>(
            scene::SceneOptions{.place = {.seed = 1, .kind = config::PlaceKind::OpenSea},
                                .quality = config::QualityTier::Low,
                                .pixelRadians = kLength / kAway / kFewestPixels},
            cast);
    }
    static void TearDownTestSuite() {
        scene().reset();
        context().reset();
    }
    ~DrawnSkinsTest() override { scene()->wear({}, 0); }
    static std::unique_ptr<gl::Context>& context() {
        static std::unique_ptr<gl::Context> one;
        return one;
    }
    static std::unique_ptr<scene::SceneRenderer>& scene() {
        static std::unique_ptr<scene::SceneRenderer> one;
        return one;
    }

    void wear(const body::SkinsByNumber& skins) { scene()->wear(skins, skins.size()); }
    // With the numbers of what the two wear.
    [[nodiscard]] Picture picture(std::array<std::uint32_t, 2> skins,
                                  float pixels = 400.0F,
                                  float shift = 0.0F) const {
        std::vector<motion::FishRecord> records;
        for (const glm::vec3 aside : {glm::vec3{0}, glm::vec3{0.26F, 0, 0}}) {
            const glm::quat turn =
                glm::angleAxis(showsLeftSide_ ? glm::pi<float>() : 0.0F, glm::vec3{0, 1, 0});
            records.push_back(test::recordOf(test::fishAt(
                place::kEyePosition + glm::vec3{0, 0, -kAway} + aside, turn, kLength)));
            records.back().skin = skins.at(records.size() - 1);
            const bool isSecond = records.size() == 2;
            if (isAway_ || (isSecond && isAlone_)) records.back().y = motion::kAwayBelow - 1;
        }
        scene::SceneFrame frame;
        frame.eyePositionMetres = place::kEyePosition;
        frame.fish.after = records;
        frame.timeSeconds = 12.0;
        scene()->update(frame);
        const unsigned texture = scene()->draw(viewOf(shift, pixels / kFewestPixels));
        EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
        Picture picture;
        picture.pixels.resize(static_cast<std::size_t>(kSize.x * kSize.y));
        glGetTextureImage(texture,
                          0,
                          GL_RGBA,
                          GL_FLOAT,
                          static_cast<GLsizei>(picture.pixels.size() * sizeof(glm::vec4)),
                          picture.pixels.data());
        return picture;
    }

    bool showsLeftSide_ = true, isAway_ = false, isAlone_ = false;
};

// What the first fish changes in the left half of the picture.
struct Changed {
    int pixels = 0, other = 0;  // other: their hue is not within the bounds
    glm::vec3 by{};             // sum of the changes
};
Changed changed(const Picture& with, const Picture& without, float leastHue, float mostHue) {
    Changed sum;
    for (int y = 0; y < kSize.y; ++y)
        for (int x = 0; x < kBetween; ++x) {
            const glm::vec3 by = with.at(x, y) - without.at(x, y);
            sum.by += by;
            if (glm::length(by) < 0.08F) continue;
            ++sum.pixels;
            const float hue = hueOf(with.at(x, y));
            if (hue < leastHue || hue > mostHue) ++sum.other;
        }
    return sum;
}

// Body and fins, either side, at every level: 95 % of its pixels have hues between 85 and 160
// degrees; the rest are the living eye, the mouth and the outline. Of the orange of its species
// nothing shines through: a tenth of its red would be seen.
TEST_F(DrawnSkinsTest, aGreenDrawingIsGreenOnBothSidesAtEveryLevel) {
    wear({{7, plain(kGreen)}});
    isAlone_ = true;
    for (const bool side : {true, false}) {
        showsLeftSide_ = side;
        for (const float pixels : kPixelsAtLevel) {
            SCOPED_TRACE(std::to_string(pixels) + " pixels");
            isAway_ = true;
            const Picture water = picture({0, 0}, pixels);
            isAway_ = false;
            const Picture fish = picture({7, 0}, pixels);
            const Changed green = changed(fish, water, 85, 160);
            const Changed own = changed(picture({0, 0}, pixels), water, 0, 360);
            EXPECT_GT(own.by.r, 1000);
            EXPECT_LT(std::abs(green.by.r), own.by.r / 10);
            EXPECT_LT(green.by.b, 0) << "it hides blue water";
            if (pixels < 4) continue;  // the water is seen through
            EXPECT_GT(green.pixels, 4000);
            EXPECT_LT(green.other, green.pixels / 20);
            for (const glm::vec2 fin : {glm::vec2{0.93F, 0.0F}, {0.47F, 0.18F}})
                EXPECT_NEAR(hueOf(fish.onFish(fin.x, fin.y, side)), 122, 38) << fin.x;
        }
    }
}

// To the bit, at every level, while the fish beside it wears a drawing.
TEST_F(DrawnSkinsTest, aNeighbourOfTheSameSpeciesDoesNotChange) {
    wear({{7, plain(kGreen)}});
    for (const float pixels : kPixelsAtLevel) {
        const Picture own = picture({0, 0}, pixels), drawn = picture({7, 0}, pixels);
        int different = 0, differentOnTheRight = 0;
        for (int y = 0; y < kSize.y; ++y)
            for (int x = 0; x < kSize.x; ++x) {
                const bool isDifferent = own.at(x, y) != drawn.at(x, y);
                different += isDifferent ? 1 : 0;
                differentOnTheRight += isDifferent && x > kBetween ? 1 : 0;
            }
        EXPECT_GT(different, 0) << pixels;
        EXPECT_EQ(pixels > 4 ? differentOnTheRight : 0, 0) << pixels;
    }
}

// A number without a picture, or none: the skin of the species.
TEST_F(DrawnSkinsTest, aFishWithoutItsPictureKeepsTheSkinOfItsSpecies) {
    const Picture own = picture({0, 0});
    EXPECT_EQ(picture({7, 0}).pixels, own.pixels) << "no drawing was ever there";
    wear({{7, plain(kGreen)}});
    EXPECT_EQ(picture({5, 0}).pixels, own.pixels) << "another drawing is there";
    EXPECT_NE(picture({7, 0}).pixels, own.pixels);
    wear({});
    EXPECT_EQ(picture({7, 0}).pixels, own.pixels) << "it has been taken down";
}

// The neighbouring channel sees the same directions 128 pixels further left.
TEST_F(DrawnSkinsTest, twoChannelsAgreeInTheirOverlap) {
    wear({{7, drawing([](glm::ivec2 at) {
               return (at.x / 8 + at.y / 8) % 2 == 0 ? kRed : kYellow;
           })}});
    constexpr int kFurther = 128;
    const float shift = 2.0F * kFurther / static_cast<float>(kSize.x);
    for (const float pixels : kPixelsAtLevel) {
        const Picture one = picture({7, 7}, pixels), other = picture({7, 7}, pixels, shift);
        float worst = 0;
        int different = 0;
        for (int y = 0; y < kSize.y; ++y)
            for (int x = kFurther; x < kSize.x; ++x) {
                const float by = glm::distance(one.at(x, y), other.at(x - kFurther, y));
                worst = std::max(worst, by);
                different += by > 2.0F / 255.0F ? 1 : 0;
            }
        EXPECT_LT(worst, 0.1F) << pixels;
        EXPECT_LT(different, 8) << pixels << ": at edges that rounding moves";
    }
}

// The head is on the right of a drawing, the back is up: on both sides of the fish.
TEST_F(DrawnSkinsTest, aDrawingLiesTheRightWayRound) {
    const glm::ivec2 middle = body::kSideTexels / 2;
    wear({{1, drawing([&](glm::ivec2 at) { return at.x < middle.x ? kBlue : kRed; })},
          {2, drawing([&](glm::ivec2 at) { return at.y < middle.y ? kGreen : kYellow; })}});
    for (const bool side : {true, false}) {
        showsLeftSide_ = side;
        for (const float pixels : {30.0F, 400.0F}) {
            const Picture halves = picture({1, 0}, pixels), backAndBelly = picture({2, 0}, pixels);
            const float head = hueOf(halves.onFish(0.20F, -0.05F, side));
            EXPECT_TRUE(head < 15 || head > 345) << head;
            EXPECT_NEAR(hueOf(halves.onFish(0.80F, 0.0F, side)), 235, 15);
            EXPECT_NEAR(hueOf(backAndBelly.onFish(0.50F, 0.10F, side)), 120, 20);
            EXPECT_NEAR(hueOf(backAndBelly.onFish(0.50F, -0.10F, side)), 40, 15);
        }
    }
}

// The array grows from 4 layers to 8 and keeps those that it has; free ones are used again.
TEST_F(DrawnSkinsTest, layersGrowAndAreUsedAgain) {
    const auto red = plain(kRed), green = plain(kGreen), blue = plain(kBlue);
    const auto hue = [&](std::uint32_t number) {
        return hueOf(picture({number, 0}).onFish(0.6F, -0.05F, true));
    };
    wear({{1, red}, {2, green}});
    EXPECT_NEAR(hue(2), 120, 20);
    wear({{1, red}, {2, green}, {3, blue}, {4, red}, {5, blue}, {6, green}});
    EXPECT_NEAR(hue(2), 120, 20);
    EXPECT_NEAR(hue(5), 235, 15);
    wear({{2, green}, {5, blue}, {7, blue}, {2'000'000, green}});
    EXPECT_NEAR(hue(2), 120, 20);
    EXPECT_NEAR(hue(7), 235, 15);
    EXPECT_NEAR(hue(2'000'000), 120, 20);
    wear({{2, blue}});
    EXPECT_NEAR(hue(2), 235, 15) << "another run of the master counts anew";
}

// So many at once, those with the lowest numbers first: a frame stays short.
TEST_F(DrawnSkinsTest, nothingIsUploadedBeyondWhatAFrameMayTake) {
    const Picture own = picture({0, 0});
    const body::SkinsByNumber skins{{1, plain(kRed)}, {2, plain(kGreen)}};
    scene()->wear(skins, 1);
    EXPECT_NE(picture({1, 0}).pixels, own.pixels);
    EXPECT_EQ(picture({2, 0}).pixels, own.pixels);
    scene()->wear(skins, 1);
    EXPECT_NE(picture({2, 0}).pixels, own.pixels);
}

}  // namespace
}  // namespace aquarama::surface
