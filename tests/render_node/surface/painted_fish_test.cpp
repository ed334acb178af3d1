// SPDX-License-Identifier: Apache-2.0
// Fish before the eye, in the light of the scene: what tells each species, what tells individuals,
// silver that vanishes and flashes.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <epoxy/gl.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtx/quaternion.hpp>
#include <gtest/gtest.h>

#include "common/place/place.h"
#include "render_node/gl/context.h"
#include "render_node/reef/mesh.h"
#include "render_node/scene/scene.h"
#include "render_node/water/water_tables.h"
#include "tests/render_node/surface/test_fish.h"
#include "tests/support/all_species.h"

namespace aquarama::surface {
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

const glm::quat kShowsLeftSide = glm::angleAxis(glm::pi<float>(), glm::vec3{0, 1, 0});

struct Sitter {
    config::Species species;
    std::uint32_t id = 0;
    glm::quat worldFromBody = kShowsLeftSide;  // it swims to the left
    glm::vec3 fromEye{0, 0, -kAway};           // the camera looks there
    config::PlaceKind place = config::PlaceKind::Reef;
    float lengthMetres = kLength;
    config::QualityTier quality = config::QualityTier::High;
};

scene::View viewTowards(glm::vec3 direction) {
    constexpr float kTangent = 0.2F, kNear = 0.05F;
    scene::View view;
    view.sizePixels = kSize;
    view.cameraFromWorld =
        glm::lookAt(place::kEyePosition, place::kEyePosition + direction, glm::vec3{0, 1, 0});
    view.clipFromCamera = glm::mat4{0.0F};
    view.clipFromCamera[0][0] =
        static_cast<float>(kSize.y) / static_cast<float>(kSize.x) / kTangent;
    view.clipFromCamera[1][1] = 1.0F / kTangent;
    view.clipFromCamera[2][3] = -1.0F;
    view.clipFromCamera[3][2] = kNear;
    return view;
}

Picture portrait(const Sitter& sitter) {
    const body::FishBody body = body::makeBody(sitter.species);
    motion::PresentedFish fish = test::fishAt(
        place::kEyePosition + sitter.fromEye, sitter.worldFromBody, sitter.lengthMetres);
    fish.id = sitter.id;
    const test::RecordedSchool school{{&fish, 1}};
    const std::vector<SchoolSpecies> cast{{.body = body,
                                           .skin = body::skinOf(sitter.species),
                                           .repertoire = test::swaying(body, 0.0F),
                                           .fish = school.traits}};
    scene::SceneRenderer scene{
        {.place = {.seed = 1, .kind = sitter.place}, .quality = sitter.quality}, cast};
    scene::SceneFrame frame;
    frame.eyePositionMetres = place::kEyePosition;
    frame.fish = school.moment();
    frame.timeSeconds = 12.0;
    scene.update(frame);
    const unsigned texture = scene.draw(viewTowards(sitter.fromEye));
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

// In the open sea, which is quickly made.
Picture portrait(const config::Species& species, std::uint32_t id = 0) {
    return portrait(Sitter{.species = species,
                           .id = id,
                           .place = config::PlaceKind::OpenSea,
                           .quality = config::QualityTier::Low});
}

TEST(PaintedFish, goldDarkAndBrightAreWhereTheyBelong) {
    const auto context = gl::makeOffscreenContext("mesa", kSize);
    const Picture picture = portrait(test::castMember("bigeye_scad"));
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
    const auto context = gl::makeOffscreenContext("mesa", kSize);
    const Picture clownfish = portrait(test::castMember("clownfish"));
    EXPECT_GT(warmth(clownfish.onFish(0.34F, 0)), 3 * warmth(clownfish.onFish(0.462F, 0))) << "bar";
    EXPECT_GT(luminance(clownfish.onFish(0.462F, 0)), 1.5F * luminance(clownfish.onFish(0.34F, 0)));

    const Picture idol = portrait(test::castMember("moorish_idol"));
    EXPECT_LT(luminance(idol.onFish(0.67F, 0)), 0.3F * luminance(idol.onFish(0.53F, 0)));
    EXPECT_GT(warmth(idol.onFish(0.56F, 0)), 1.5F * warmth(idol.onFish(0.37F, 0))) << "lemon";

    const Picture tang = portrait(test::castMember("blue_tang"));
    EXPECT_GT(warmth(tang.onFish(0.90F, 0)), 8 * warmth(tang.onFish(0.50F, -0.05F))) << "tail";
    EXPECT_LT(luminance(tang.onFish(0.62F, 0.06F)), 0.6F * luminance(tang.onFish(0.50F, -0.05F)));

    const Picture parrotfish = portrait(test::castMember("parrotfish"));
    EXPECT_GT(warmth(parrotfish.onFish(0.150F, -0.03F)),
              1.5F * warmth(parrotfish.onFish(0.5F, -0.09F)))
        << "a peach cheek on a green fish";

    const Picture trumpetfish = portrait(test::castMember("trumpetfish"));
    EXPECT_GT(warmth(trumpetfish.onFish(0.5F, 0)), 2.0F);

    const Picture shark = portrait(test::castMember("blacktip_reef_shark"));
    EXPECT_LT(luminance(shark.onFish(0.40F, 0.04F)), 0.6F * luminance(shark.onFish(0.40F, -0.03F)));
}

// The largest sea goldies are males. In the picture all are of one size: a smaller fish is nearer.
TEST(PaintedFish, seaGoldiesOfATenthOfAMetreAreVioletAndSmallerOnesOrange) {
    const auto context = gl::makeOffscreenContext("mesa", kSize);
    const auto flankOf = [](float lengthMetres) {
        return portrait(Sitter{.species = test::castMember("sea_goldie"),
                               .fromEye = {0, 0, -kAway * lengthMetres / kLength},
                               .place = config::PlaceKind::OpenSea,
                               .lengthMetres = lengthMetres,
                               .quality = config::QualityTier::Low})
            .onFish(0.45F, 0.0F);
    };
    const glm::vec3 female = flankOf(0.09F), male = flankOf(0.11F);
    EXPECT_GT(female.g, 1.5F * female.b);
    EXPECT_GT(male.b, 1.5F * male.g);
    EXPECT_GT(male.r, male.b);
}

// A species of which no painter knows is plain: its file's back, flank and belly.
TEST(PaintedFish, aNewSpeciesWearsTheColoursOfItsFile) {
    const auto context = gl::makeOffscreenContext("mesa", kSize);
    config::Species species = test::castMember("blue_tang");
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

glm::vec3 meanOf(const Picture& picture) {
    glm::vec3 sum{};
    for (const glm::vec4& pixel : picture.pixels) sum += glm::vec3(pixel);
    return sum / static_cast<float>(picture.pixels.size());
}

// What an id changes is the fish alone, and always in the same way.
TEST(PaintedFish, individualsDifferAndStayThemselves) {
    const auto context = gl::makeOffscreenContext("mesa", kSize);
    for (const std::string& name : test::allSpeciesNames()) {
        const config::Species species = test::castMember(name);
        const Picture one = portrait(species, 3), other = portrait(species, 8);
        EXPECT_GT(glm::distance(meanOf(one), meanOf(other)), 2.0e-5F) << name;
    }
    const config::Species scad = test::castMember("bigeye_scad");
    EXPECT_EQ(portrait(scad, 3).pixels, portrait(scad, 3).pixels);
}

// A painted fish sends back no more light than a white one in the same place: matte ones, as a
// mirror may show the sun.
TEST(PaintedFish, noMatteFishIsBrighterThanAWhiteOne) {
    const auto context = gl::makeOffscreenContext("mesa", kSize);
    for (const char* name : {"clownfish", "moorish_idol", "blue_tang", "parrotfish"}) {
        const Picture painted = portrait(test::castMember(name));
        config::Species white = test::castMember(name);
        white.name = "white_fish";
        white.palette = {{"back", glm::vec3(1)}, {"flank", glm::vec3(1)}, {"belly", glm::vec3(1)}};
        const Picture plain = portrait(white);
        int brighter = 0;
        for (std::size_t i = 0; i < painted.pixels.size(); ++i)
            if (luminance(painted.pixels[i]) > luminance(plain.pixels[i]) + 0.08F) ++brighter;
        // Tilted scales and the catch light of the eye glint here and there.
        EXPECT_LT(brighter, static_cast<int>(painted.pixels.size() / 500)) << name;
    }
}

// The flank of a scad that swims across the view in the open sea, and the water behind it.
struct FlankAndWater {
    float flank, water;
};
FlankAndWater acrossTheView(glm::vec3 direction, float rollRadians) {
    constexpr float kBeyondTheLamp = 14.0F;  // metres; a fish that is large enough to be measured
    const glm::vec3 forwards = glm::normalize(glm::cross(glm::vec3{0, 1, 0}, direction));
    const glm::quat level = glm::rotation(glm::vec3{1, 0, 0}, forwards);
    const Picture picture =
        portrait(Sitter{.species = test::castMember("bigeye_scad"),
                        .worldFromBody = glm::angleAxis(rollRadians, forwards) * level,
                        .fromEye = kBeyondTheLamp * direction,
                        .place = config::PlaceKind::OpenSea,
                        .lengthMetres = 0.08F * kBeyondTheLamp});
    const glm::ivec2 middle = kSize / 2;
    const auto meanAbout = [&](glm::ivec2 centre) {
        float sum = 0;
        for (int x = -6; x <= 6; ++x)
            for (int y = -2; y <= 2; ++y) sum += luminance(picture.at(centre + glm::ivec2{x, y}));
        return sum / 65;
    };
    return {meanAbout(middle + glm::ivec2{0, -2}),
            0.5F * (meanAbout(middle + glm::ivec2{0, 40}) + meanAbout(middle - glm::ivec2{0, 40}))};
}

// Denton 1970: platelets stand upright and mirror the level water, which is as bright on both sides
// of the sun; rolled towards the sun they mirror the surface. 15 % of the radiance is 0.24 of the
// display's light, whose curve has a toe; shafts and the lamp are in it.
TEST(PaintedFish, silverVanishesUprightAndFlashesWhenItRolls) {
    const auto context = gl::makeOffscreenContext("mesa", kSize);
    const glm::vec3 sun = scene::sunInWater();
    for (const float side : {-1.0F, 1.0F}) {
        const glm::vec3 across = side * glm::normalize(glm::vec3{-sun.z, 0, sun.x});
        const FlankAndWater upright = acrossTheView(across, 0);
        EXPECT_NEAR(upright.flank, upright.water, 0.24F * upright.water);
    }
    const glm::vec3 awayFromSun = glm::normalize(glm::vec3{-sun.x, 0, -sun.z});
    const float upright = acrossTheView(awayFromSun, 0).flank;
    EXPECT_GT(acrossTheView(awayFromSun, 0.52F).flank, 4 * upright) << "rolled by 30 degrees";
}

}  // namespace
}  // namespace aquarama::surface
