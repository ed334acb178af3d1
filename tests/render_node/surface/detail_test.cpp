// SPDX-License-Identifier: Apache-2.0
// What a visitor could see of levels of detail: nothing jumps as a fish swims away.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include <epoxy/gl.h>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "render_node/gl/context.h"
#include "render_node/scene/scene.h"
#include "tests/render_node/surface/test_fish.h"
#include "tests/support/cast.h"
#include "tests/support/flip.h"
#include "tests/support/golden_stills.h"

namespace aquarama::surface {
namespace {

constexpr float kLength = 0.24F;
const glm::vec3 kEye{0, -6, 0};

// Of the difference that the fish makes at all. Rounding moves some pixels of the outline too.
constexpr double kMostJump = 0.05;

using Pixels = std::vector<glm::vec3>;  // display light

// How much two pictures differ: sums over pixels and colours, in 8-bit codes of display light.
double difference(const Pixels& a, const Pixels& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const glm::vec3 d = glm::abs(a[i] - b.at(i));
        sum += static_cast<double>(d.x + d.y + d.z) / 3.0 * 255.0;
    }
    return sum;
}

// A wall of one small picture before which fish of one species swim in the open sea.
class Wall {
  public:
    Wall(const std::string& species, const test::Camera& camera, std::size_t fish)
        : camera_{camera} {
        camera_.eyeMetres = kEye;
        const config::Species member = test::castMember(species);
        const body::FishBody body = body::makeBody(member);
        SchoolSpecies school{body, body::skinOf(member), test::swaying(body, 0.05F), {}};
        for (std::size_t i = 0; i < fish; ++i)
            school.fish.push_back({static_cast<std::uint32_t>(i), 240});
        scene::SceneOptions options;
        options.place.kind = config::PlaceKind::OpenSea;
        options.pixelRadians = test::pixelRadiansOf(camera_);
        scene_ = std::make_unique<scene::SceneRenderer>(options, std::span(&school, 1));
    }

    [[nodiscard]] Pixels shown(const std::vector<motion::PresentedFish>& fish) {
        const test::RecordedSchool school{fish};
        scene::SceneFrame frame;
        frame.timeSeconds = 12.0;
        frame.eyePositionMetres = kEye;
        frame.fish = school.moment();
        scene_->update(frame);
        const unsigned texture = scene_->draw(test::viewOf(camera_));
        const glm::ivec2 size = camera_.sizePixels;
        Pixels pixels(static_cast<std::size_t>(size.x * size.y));
        glGetTextureImage(texture,
                          0,
                          GL_RGB,
                          GL_FLOAT,
                          static_cast<GLsizei>(pixels.size() * sizeof(glm::vec3)),
                          pixels.data());
        return pixels;
    }

    // So far that a fish there fills so many pixels.
    [[nodiscard]] float metresFor(float pixels) const {
        return kLength / (pixels * test::pixelRadiansOf(camera_));
    }

  private:
    test::Camera camera_;
    std::unique_ptr<scene::SceneRenderer> scene_;
};

// A picture that a fish of so many pixels fills at two metres.
test::Camera cameraFor(float pixels) {
    const float pixelRadians = kLength / (2.0F * pixels);
    test::Camera camera;
    camera.sizePixels = {static_cast<int>(1.3F * pixels) + 12,
                         static_cast<int>(0.9F * pixels) + 12};
    const float tangent = 0.5F * pixelRadians * static_cast<float>(camera.sizePixels.y);
    camera.heightDegrees = 2.0F * glm::degrees(std::atan(tangent));
    return camera;
}

class DetailTest : public testing::Test {
  protected:
    static void SetUpTestSuite() { context() = gl::makeOffscreenContext("mesa", {64, 64}); }
    static void TearDownTestSuite() { context().reset(); }
    static std::unique_ptr<gl::Context>& context() {
        static std::unique_ptr<gl::Context> one;
        return one;
    }
};

motion::PresentedFish fishAway(float metres) {
    const glm::quat turn = glm::angleAxis(glm::radians(200.0F), glm::vec3{0, 1, 0});
    motion::PresentedFish fish =
        test::fishAt(kEye + glm::vec3{0.3F * kLength / 8, 0, -metres}, turn, kLength);
    fish.phase = 0.1F;
    return fish;
}

// A fish on one side of a limit and on the other, hardly any further away: what differs is what the
// level alone does.
TEST_F(DetailTest, noLimitLeavesAJump) {
    constexpr float kNear = 2e-4F;
    for (const std::string species : {"bigeye_scad", "moorish_idol"})
        for (const float limit : {2.5F, 4.0F, 20.0F, 60.0F, 180.0F}) {
            Wall wall(species, cameraFor(limit), 1);
            const Pixels water = wall.shown({});
            const auto at = [&](float pixels) {
                return wall.shown({fishAway(wall.metresFor(pixels))});
            };
            const Pixels before = at(limit * (1.0F - kNear)), after = at(limit * (1.0F + kNear));
            const double jump = difference(before, after) / difference(after, water);
            RecordProperty(species + "_" + std::to_string(limit), std::to_string(jump));
            EXPECT_LT(jump, kMostJump) << species << " at " << limit << " pixels";
        }
}

// Many fish, so that which pixels' centres are hit is averaged out. What they change of the picture
// for their area goes down with the metres of water between, never by steps: the share that a metre
// takes is that of the whole way.
TEST_F(DetailTest, fishThatSwimAwayGrowFainterEvenly) {
    constexpr std::size_t kFish = 200;
    test::Camera camera;
    camera.sizePixels = {384, 216};
    camera.heightDegrees = 90.0F;
    Wall wall("moorish_idol", camera, kFish);
    const Pixels water = wall.shown({});
    std::vector<double> metres, lights;
    for (float pixels = 18.0F; pixels > 1.6F; pixels /= 1.1F) {
        std::vector<motion::PresentedFish> fish;
        for (std::size_t i = 0; i < kFish; ++i) {
            const float k = static_cast<float>(i);
            const glm::vec2 slope{1.6F * std::sin(12.9898F * k), 0.9F * std::sin(78.233F * k)};
            const glm::vec3 towards = glm::normalize(glm::vec3{slope, -1.0F});
            const glm::quat turn = glm::angleAxis(2.4F * k, glm::vec3{0, 1, 0});
            fish.push_back(test::fishAt(kEye + wall.metresFor(pixels) * towards, turn, kLength));
            fish.back().id = static_cast<std::uint32_t>(i);
        }
        metres.push_back(static_cast<double>(wall.metresFor(pixels)));
        lights.push_back(difference(wall.shown(fish), water) /
                         static_cast<double>(pixels * pixels));
    }
    const double perMetre =
        std::log(lights.front() / lights.back()) / (metres.back() - metres.front());
    EXPECT_GT(perMetre, 0.05) << "the water takes light";
    for (std::size_t i = 1; i < lights.size(); ++i) {
        const double expected = std::exp(-perMetre * (metres[i] - metres[i - 1]));
        EXPECT_NEAR(lights[i] / lights[i - 1], expected, 0.13) << metres[i] << " m";
    }
}

// The same frame with and without culling and levels of detail, by a metric of what people see. See
// fish_stages in tests/bench for what it saves.
TEST_F(DetailTest, peopleDoNotSeeWhatIsSaved) {
    test::Still still;
    still.camera.sizePixels = {480, 270};
    still.options.place.kind = config::PlaceKind::OpenSea;
    for (int i = 0; i < 40; ++i) {
        const float k = static_cast<float>(i);
        test::Camera towards = still.camera;
        towards.azimuthDegrees = 36.0F * std::sin(12.9898F * k);
        towards.elevationDegrees = 20.0F * std::sin(78.233F * k);
        const std::string species = i % 8 == 0 ? "moorish_idol" : "bigeye_scad";
        still.fish.push_back(
            test::portraitOf(species, towards, 1.0F + 0.3F * k, 137.5F * k, 0.24F));
    }
    const Picture on = test::pictureOf(still);
    still.options.levelsOfDetail = still.options.culling = false;
    const Picture off = test::pictureOf(still);
    const double apart = test::meanFlip(off, on);
    RecordProperty("flip", std::to_string(apart));
    EXPECT_LE(apart, 0.02);
    EXPECT_GT(apart, 0.0) << "nothing was saved";
}

// Each level as it was when somebody last looked and found it right.
TEST_F(DetailTest, eachLevelIsAsItWas) {
    for (const test::GoldenStill& golden : test::goldenStills("lod/"))
        test::expectGolden(test::pictureOf(golden.still), golden.name, golden.limits);
}

}  // namespace
}  // namespace aquarama::surface
