// SPDX-License-Identifier: Apache-2.0
// The picture itself, on software GL.
#include "render_node/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include <epoxy/gl.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "common/place/place.h"
#include "render_node/gl/context.h"

namespace aquarama::scene {
namespace {

constexpr glm::ivec2 kSize{320, 288};
const glm::vec2 kHalfTangents{0.47F, 0.47F};  // 25 degrees to all sides

struct Shot {
    std::vector<glm::vec3> pixels;  // display light, bottom row first
    [[nodiscard]] glm::vec3 at(int x, int y) const {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(kSize.x) +
                      static_cast<std::size_t>(x)];
    }
};

// Reversed depth, zero to one, far plane at infinity.
View viewTowards(float azimuthDegrees) {
    constexpr float kNear = 0.1F;
    View view;
    view.sizePixels = kSize;
    view.clipFromCamera = glm::mat4{0.0F};
    view.clipFromCamera[0][0] = 1.0F / kHalfTangents.x;
    view.clipFromCamera[1][1] = 1.0F / kHalfTangents.y;
    view.clipFromCamera[2][3] = -1.0F;
    view.clipFromCamera[3][2] = kNear;
    view.cameraFromWorld =
        glm::rotate(glm::mat4{1.0F}, glm::radians(azimuthDegrees), glm::vec3{0, 1, 0}) *
        glm::translate(glm::mat4{1.0F}, -place::kEyePosition);
    return view;
}

struct Water {
    std::vector<FoodParticle> food;
    float daylight = 1.0F;
};

Shot shoot(SceneRenderer& scene,
           double timeSeconds,
           float azimuthDegrees,
           const Water& water = {}) {
    SceneFrame frame;
    frame.timeSeconds = timeSeconds;
    frame.eyePositionMetres = place::kEyePosition;
    frame.food = water.food;
    frame.daylight = water.daylight;
    scene.update(frame);
    const unsigned texture = scene.draw(viewTowards(azimuthDegrees));
    Shot shot;
    shot.pixels.resize(static_cast<std::size_t>(kSize.x) * static_cast<std::size_t>(kSize.y));
    glGetTextureImage(texture,
                      0,
                      GL_RGB,
                      GL_FLOAT,
                      static_cast<GLsizei>(shot.pixels.size() * sizeof(glm::vec3)),
                      shot.pixels.data());
    return shot;
}

class Place : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        context() = gl::makeOffscreenContext("auto", {16, 16});
        scene() = fresh({});
    }
    static void TearDownTestSuite() {
        scene().reset();
        context().reset();
    }
    static std::unique_ptr<SceneRenderer> fresh(const SceneOptions& options) {
        return std::make_unique<SceneRenderer>(options, std::span<const surface::SchoolSpecies>{});
    }
    static std::unique_ptr<gl::Context>& context() {
        static std::unique_ptr<gl::Context> instance;
        return instance;
    }
    static std::unique_ptr<SceneRenderer>& scene() {
        static std::unique_ptr<SceneRenderer> instance;
        return instance;
    }
};

TEST_F(Place, drawsWithoutAnErrorOfGl) {
    shoot(*scene(), 1.0, 0.0);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

// Neither black nor blinding, on any channel: the veil of light keeps it above a projector's black.
TEST_F(Place, lightIsWithinWhatAWallBears) {
    for (const float azimuth : {-40.0F, 0.0F, 40.0F}) {
        const Shot shot = shoot(*scene(), 12.0, azimuth);
        double sum = 0;
        int clipped = 0;
        for (const glm::vec3& pixel : shot.pixels) {
            sum += static_cast<double>(pixel.r) * 0.2126 + static_cast<double>(pixel.g) * 0.7152 +
                   static_cast<double>(pixel.b) * 0.0722;
            clipped += std::max({pixel.r, pixel.g, pixel.b}) > 0.995F ? 1 : 0;
            ASSERT_GE(std::min({pixel.r, pixel.g, pixel.b}), 0.0F);
        }
        const auto count = static_cast<double>(shot.pixels.size());
        EXPECT_GT(sum / count, 0.05) << azimuth;
        EXPECT_LT(sum / count, 0.20) << azimuth;
        EXPECT_LT(clipped / count, 0.005) << azimuth;
    }
}

// A node that has just restarted draws what its neighbours draw.
TEST_F(Place, historyNeverChangesWhatIsSeen) {
    shoot(*scene(), 3.0, -40.0F);
    const Shot veteran = shoot(*scene(), 7.25, 20.0F);
    const auto restarted = fresh({});
    EXPECT_EQ(shoot(*restarted, 7.25, 20.0F).pixels, veteran.pixels);
}

TEST_F(Place, moves) {
    EXPECT_NE(shoot(*scene(), 1.0, 0.0F).pixels, shoot(*scene(), 1.1, 0.0F).pixels);
}

TEST_F(Place, cullingHidesNothingThatIsSeen) {
    SceneOptions options;
    options.culling = false;
    const auto all = fresh(options);
    EXPECT_EQ(shoot(*all, 5.0, 40.0F).pixels, shoot(*scene(), 5.0, 40.0F).pixels);
}

double meanOf(const Shot& shot, int channel) {
    double sum = 0;
    for (const glm::vec3& pixel : shot.pixels) sum += static_cast<double>(pixel[channel]);
    return sum / static_cast<double>(shot.pixels.size());
}

// The day goes down to a blue dusk, never to a dark wall.
TEST_F(Place, getsDarkerAndBluerTowardsTheNight) {
    const Shot noon = shoot(*scene(), 5.0, 0.0F);
    double light = meanOf(noon, 1);
    double blueness = meanOf(noon, 2) / meanOf(noon, 1);
    for (const float daylight : {0.8F, 0.5F, 0.2F}) {
        const Shot later = shoot(*scene(), 5.0, 0.0F, {{}, daylight});
        EXPECT_LT(meanOf(later, 1), light) << daylight;
        EXPECT_GT(meanOf(later, 2) / meanOf(later, 1), blueness) << daylight;
        light = meanOf(later, 1);
        blueness = meanOf(later, 2) / meanOf(later, 1);
    }
    EXPECT_GT(light, 0.005);
    EXPECT_EQ(shoot(*scene(), 5.0, 0.0F).pixels, noon.pixels);
}

std::vector<FoodParticle> foodAt(glm::vec3 fromEye, bool isPellet) {
    return {{place::kEyePosition + fromEye, 77, isPellet}};
}

// How much redder than without, summed over a square about a pixel.
double addedRed(const Shot& with, const Shot& without, glm::ivec2 pixel) {
    double sum = 0;
    for (int y = pixel.y - 6; y <= pixel.y + 6; ++y)
        for (int x = pixel.x - 6; x <= pixel.x + 6; ++x)
            sum += static_cast<double>(with.at(x, y).r) - static_cast<double>(without.at(x, y).r);
    return sum;
}

TEST_F(Place, aPelletIsAWarmCrumbInItsPlaceAndNowhereElse) {
    const Shot without = shoot(*scene(), 5.0, 0.0F);
    const Shot with = shoot(*scene(), 5.0, 0.0F, {foodAt({0, 0, -3}, true), 1});
    EXPECT_GT(addedRed(with, without, kSize / 2), 0.3);
    int elsewhere = 0;
    for (int y = 0; y < kSize.y; ++y)
        for (int x = 0; x < kSize.x; ++x) {
            const bool isThere = std::abs(x - kSize.x / 2) <= 6 && std::abs(y - kSize.y / 2) <= 6;
            elsewhere += !isThere && with.at(x, y) != without.at(x, y) ? 1 : 0;
        }
    EXPECT_EQ(elsewhere, 0);
}

TEST_F(Place, planktonIsFainterThanAPellet) {
    const Shot without = shoot(*scene(), 5.0, 0.0F);
    const auto red = [&](bool isPellet) {
        const Shot with = shoot(*scene(), 5.0, 0.0F, {foodAt({0, 0, -3}, isPellet), 1});
        return addedRed(with, without, kSize / 2);
    };
    EXPECT_GT(red(false), 0.002);
    EXPECT_LT(red(false), 0.5 * red(true));
}

// What is behind the eye, too far away or hidden by the sand is not seen.
TEST_F(Place, foodThatCannotBeSeenChangesNothing) {
    const Shot without = shoot(*scene(), 5.0, 0.0F);
    for (const glm::vec3 place : {glm::vec3(0, 0, 3), glm::vec3(0, 0, -30), glm::vec3(0, -5, -6)})
        for (const bool isPellet : {true, false})
            EXPECT_EQ(shoot(*scene(), 5.0, 0.0F, {foodAt(place, isPellet), 1}).pixels,
                      without.pixels);
}

// The pixel in which a view shows a direction; empty outside the picture.
std::optional<glm::vec2> pixelOf(float viewAzimuth, float azimuth, float elevation) {
    const float across = std::tan(glm::radians(azimuth - viewAzimuth));
    const float up =
        std::tan(glm::radians(elevation)) / std::cos(glm::radians(azimuth - viewAzimuth));
    const glm::vec2 ndc = glm::vec2{across, up} / kHalfTangents;
    if (std::abs(ndc.x) > 0.98F || std::abs(ndc.y) > 0.98F) return {};
    return (ndc * 0.5F + 0.5F) * glm::vec2(kSize);
}

glm::vec3 sampled(const Shot& shot, glm::vec2 pixel) {
    const glm::vec2 corner = glm::floor(pixel - 0.5F);
    const glm::vec2 t = pixel - 0.5F - corner;
    const int x = static_cast<int>(corner.x);
    const int y = static_cast<int>(corner.y);
    return glm::mix(glm::mix(shot.at(x, y), shot.at(x + 1, y), t.x),
                    glm::mix(shot.at(x, y + 1), shot.at(x + 1, y + 1), t.x),
                    t.y);
}

// Means over blocks of about 16 x 16 pixels of the overlap of two views 30 degrees apart.
std::vector<float> differencesAlongTheSeam(const Shot& left, const Shot& right, float between) {
    constexpr float kBlockDegrees = 2.6F;
    constexpr int kSteps = 16;
    std::vector<float> differences;
    for (float azimuth = -9.0F; azimuth < 7.0F; azimuth += kBlockDegrees)
        for (float elevation = -20.0F; elevation < 19.0F; elevation += kBlockDegrees) {
            glm::vec3 sum{0.0F};
            int count = 0;
            for (int i = 0; i < kSteps * kSteps; ++i) {
                const int column = i % kSteps;
                const int row = i / kSteps;
                const float a = azimuth + kBlockDegrees * static_cast<float>(column) / kSteps;
                const float e = elevation + kBlockDegrees * static_cast<float>(row) / kSteps;
                const auto l = pixelOf(-between / 2.0F, a, e);
                const auto r = pixelOf(between / 2.0F, a, e);
                if (!l || !r) continue;
                sum += sampled(left, *l) - sampled(right, *r);
                ++count;
            }
            if (count < kSteps * kSteps) continue;
            const glm::vec3 mean = glm::abs(sum / static_cast<float>(count));
            differences.push_back(255.0F * std::max({mean.r, mean.g, mean.b}));
        }
    return differences;
}

TEST_F(Place, neighboursAgreeWhereTheyOverlap) {
    constexpr float kBetween = 30.0F;
    const auto smooth = fresh({.quality = config::QualityTier::High});
    const Shot left = shoot(*smooth, 9.0, -kBetween / 2.0F);
    const Shot right = shoot(*smooth, 9.0, kBetween / 2.0F);
    std::vector<float> codes = differencesAlongTheSeam(left, right, kBetween);
    ASSERT_GT(codes.size(), 60U);
    std::ranges::sort(codes);
    EXPECT_LT(codes[codes.size() / 2], 0.5F);
    EXPECT_LT(codes[codes.size() * 9 / 10], 2.0F);
    // Blades of grass thinner than a pixel fall between the samples now of one view, now of the
    // other.
    EXPECT_LT(codes.back(), 6.0F);
}

}  // namespace
}  // namespace aquarama::scene
