// SPDX-License-Identifier: Apache-2.0
// A scad before the eye, in the light of the scene: gold, dark and bright where they belong.
#include <cmath>
#include <memory>
#include <vector>

#include <epoxy/gl.h>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "common/place/place.h"
#include "render_node/context/context.h"
#include "render_node/scene/scene.h"
#include "tests/render_node/surface/test_fish.h"
#include "tests/support/cast.h"

namespace aquarama {
namespace {

constexpr glm::ivec2 kSize{600, 300};
constexpr float kLength = 0.24F, kAway = 0.7F;

struct Picture {
    std::vector<glm::vec4> pixels;

    [[nodiscard]] glm::vec3 at(glm::ivec2 pixel) const {
        return pixels.at(static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(kSize.x) +
                         static_cast<std::size_t>(pixel.x));
    }
    // Mean of 5 x 5 pixels about a place on the fish's left side.
    [[nodiscard]] glm::vec3 onFish(float s, float y) const {
        const glm::vec3 place{(s - test::kCentreStation) * kLength, y * kLength, -kAway};
        const float f = static_cast<float>(kSize.y) / 0.4F;  // pixels a unit of slope
        const glm::ivec2 centre{
            static_cast<int>(static_cast<float>(kSize.x) / 2 + f * place.x / kAway),
            static_cast<int>(static_cast<float>(kSize.y) / 2 + f * place.y / kAway)};
        glm::vec3 sum{};
        for (int dy = -2; dy <= 2; ++dy) {
            for (int dx = -2; dx <= 2; ++dx) sum += at(centre + glm::ivec2{dx, dy});
        }
        return sum / 25.0F;
    }
};

float luminance(glm::vec3 c) {
    return glm::dot(c, glm::vec3{0.2126F, 0.7152F, 0.0722F});
}

// The fish swims to the left, so the eye sees its left side.
Picture portrait(const Species& species) {
    const FishBody body = makeBody(species);
    const PresentedFish fish = test::fishAt(kEyePosition + glm::vec3{0, 0, -kAway},
                                            glm::angleAxis(glm::pi<float>(), glm::vec3{0, 1, 0}),
                                            kLength);
    const test::RecordedSchool school{{&fish, 1}};
    const std::vector<SchoolSpecies> cast{{.body = body,
                                           .skin = skinOf(species),
                                           .repertoire = test::swaying(body, 0.0F),
                                           .fish = school.traits}};
    SceneRenderer scene{{.seed = 1, .quality = QualityTier::High}, cast};
    View view;
    view.sizePixels = kSize;
    view.cameraFromWorld = glm::translate(glm::mat4{1.0F}, -kEyePosition);
    view.clipFromCamera = glm::mat4{0.0F};
    view.clipFromCamera[0][0] = static_cast<float>(kSize.y) / static_cast<float>(kSize.x) / 0.2F;
    view.clipFromCamera[1][1] = 1.0F / 0.2F;
    view.clipFromCamera[2][3] = -1.0F;
    view.clipFromCamera[3][2] = 0.05F;
    SceneFrame frame;
    frame.eyePositionMetres = kEyePosition;
    frame.fish = school.moment();
    scene.update(frame);
    const unsigned texture = scene.draw(view);
    Picture picture;
    picture.pixels.resize(static_cast<std::size_t>(kSize.x) * static_cast<std::size_t>(kSize.y));
    glGetTextureImage(texture,
                      0,
                      GL_RGBA,
                      GL_FLOAT,
                      static_cast<GLsizei>(picture.pixels.size() * sizeof(glm::vec4)),
                      picture.pixels.data());
    return picture;
}

TEST(PaintedFish, goldDarkAndBrightAreWhereTheyBelong) {
    const auto context = makeOffscreenContext("mesa", kSize);
    const Picture picture = portrait(castMember("bigeye_scad"));
    const glm::vec3 water = picture.onFish(0.5F, 0.3F);
    const glm::vec3 back = picture.onFish(0.40F, 0.095F), flank = picture.onFish(0.45F, -0.02F),
                    belly = picture.onFish(0.42F, -0.08F), line = picture.onFish(0.42F, 0.038F),
                    pupil = picture.onFish(0.100F, 0.014F), iris = picture.onFish(0.100F, -0.010F),
                    cheek = picture.onFish(0.17F, -0.03F), tail = picture.onFish(0.88F, 0.03F);
    EXPECT_LT(luminance(back), 0.6F * luminance(flank));
    EXPECT_LT(luminance(back), 0.6F * luminance(belly));
    EXPECT_GT(line.r / line.b, 1.5F * flank.r / flank.b);   // golden
    EXPECT_GT(tail.g / tail.b, 1.15F * cheek.g / cheek.b);  // yellow-grey
    EXPECT_LT(luminance(pupil), 0.3F * luminance(iris));
    EXPECT_LT(luminance(pupil), 0.3F * luminance(cheek));
    // Around the fish is water, not fish.
    EXPECT_GT(glm::distance(water, flank), 0.05F);
    EXPECT_LT(water.r, water.b);
}

float warmth(glm::vec3 c) {
    return c.r / c.b;
}

// What tells the others from afar, each on the left side of the body.
TEST(PaintedFish, everyFishOfTheReefWearsItsColours) {
    const auto context = makeOffscreenContext("mesa", kSize);
    const Picture clownfish = portrait(castMember("clownfish"));
    EXPECT_GT(warmth(clownfish.onFish(0.34F, 0)), 3 * warmth(clownfish.onFish(0.462F, 0))) << "bar";
    EXPECT_GT(luminance(clownfish.onFish(0.462F, 0)), 1.5F * luminance(clownfish.onFish(0.34F, 0)));

    const Picture idol = portrait(castMember("moorish_idol"));
    EXPECT_LT(luminance(idol.onFish(0.67F, 0)), 0.3F * luminance(idol.onFish(0.53F, 0)));
    EXPECT_GT(warmth(idol.onFish(0.56F, 0)), 1.5F * warmth(idol.onFish(0.37F, 0))) << "lemon";

    const Picture tang = portrait(castMember("blue_tang"));
    EXPECT_GT(warmth(tang.onFish(0.90F, 0)), 8 * warmth(tang.onFish(0.50F, -0.05F))) << "tail";
    EXPECT_LT(luminance(tang.onFish(0.62F, 0.06F)), 0.6F * luminance(tang.onFish(0.50F, -0.05F)));

    const Picture parrotfish = portrait(castMember("parrotfish"));
    EXPECT_GT(warmth(parrotfish.onFish(0.150F, -0.03F)),
              1.5F * warmth(parrotfish.onFish(0.5F, -0.09F)))
        << "a peach cheek on a green fish";

    const Picture trumpetfish = portrait(castMember("trumpetfish"));
    EXPECT_GT(warmth(trumpetfish.onFish(0.5F, 0)), 2.0F);

    const Picture shark = portrait(castMember("blacktip_reef_shark"));
    EXPECT_LT(luminance(shark.onFish(0.40F, 0.04F)), 0.6F * luminance(shark.onFish(0.40F, -0.03F)));
}

// A species of which no painter knows is plain: its file's back, flank and belly.
TEST(PaintedFish, aNewSpeciesWearsTheColoursOfItsFile) {
    const auto context = makeOffscreenContext("mesa", kSize);
    Species species = castMember("blue_tang");
    species.name = "new_fish";
    species.palette = {{"back", {0.5F, 0.02F, 0.02F}},
                       {"flank", {0.02F, 0.5F, 0.02F}},
                       {"belly", {0.6F, 0.6F, 0.6F}}};
    const Picture picture = portrait(species);
    const glm::vec3 back = picture.onFish(0.45F, 0.16F);
    const glm::vec3 flank = picture.onFish(0.50F, 0.0F);
    EXPECT_GT(back.r, back.g);
    EXPECT_GT(flank.g, 2 * flank.r);
}

}  // namespace
}  // namespace aquarama
