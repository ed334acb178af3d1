// SPDX-License-Identifier: Apache-2.0
// The water as it is seen, on software GL: every type, levels of light, and what the passes over
// the picture do where two channels overlap.
#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

#include "common/base/picture.h"
#include "render_node/gl/context.h"
#include "render_node/shaders/shader_interface.h"
#include "tests/support/colour_difference.h"
#include "tests/support/golden_stills.h"

namespace aquarama::test {
namespace {

class WaterPicture : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        context = gl::makeOffscreenContext("auto", {16, 16});
        photographer = std::make_unique<Photographer>();
    }
    static void TearDownTestSuite() {
        photographer.reset();
        context.reset();
    }
    static Picture pictureOf(const Still& still) { return photographer->pictureOf(still); }

  private:
    static inline std::unique_ptr<gl::Context> context;
    static inline std::unique_ptr<Photographer> photographer;
};

TEST_F(WaterPicture, everyTypeIsAsItWasAndTheEyeDivesFromTheSurfaceToTheDeep) {
    for (const GoldenStill& golden : goldenStills("water/"))
        expectGolden(pictureOf(golden.still), golden.name, golden.limits);
}

struct Levels {
    double mean = 0, darkest = 0, clipped = 0;  // linear; the darkest hundredth; share of pixels
};

Levels levelsOf(const Picture& picture) {
    std::vector<double> lights;
    Levels levels;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
        const auto linear = [&](std::size_t c) {
            return linearFromSrgb(picture.rgb[i + c] / 255.0);
        };
        lights.push_back(0.2126 * linear(0) + 0.7152 * linear(1) + 0.0722 * linear(2));
        const int brightest = std::max({picture.rgb[i], picture.rgb[i + 1], picture.rgb[i + 2]});
        levels.clipped += brightest > 254 ? 1 : 0;
        levels.mean += lights.back();
    }
    const auto count = static_cast<double>(lights.size());
    std::ranges::sort(lights);
    levels.darkest = lights[lights.size() / 100];
    levels.mean /= count;
    levels.clipped /= count;
    return levels;
}

// A projector's black is a 1500th of its white: the veil of light keeps all well above it. Brighter
// means would light the hall.
TEST_F(WaterPicture, lightIsWithinWhatAWallBears) {
    constexpr double kBlack = 1.0 / 1500;
    for (const float azimuth : {-40.0F, 0.0F, 40.0F}) {
        Still still = reefIn(config::WaterType::IA);
        still.camera.azimuthDegrees = azimuth;
        const Levels levels = levelsOf(pictureOf(still));
        EXPECT_GT(levels.mean, 0.05) << azimuth;
        EXPECT_LT(levels.mean, 0.20) << azimuth;
        EXPECT_GT(levels.darkest, 10 * kBlack) << azimuth;
        EXPECT_LT(levels.clipped, 0.005) << azimuth;
    }
    for (const float depth : {6.0F, 12.0F, 25.0F}) {
        const Levels levels = levelsOf(pictureOf(openSea(depth)));
        EXPECT_GT(levels.mean, 0.04) << depth;
        EXPECT_LT(levels.mean, 0.25) << depth;
        EXPECT_GT(levels.darkest, 10 * kBlack) << depth;
    }
}

// Blue, and bluer the farther: no neon, where one colour stands at its end and another at nothing.
TEST_F(WaterPicture, clearWaterIsABlueThatADisplayCanShow) {
    const Picture picture = pictureOf(openSea(12.0F));
    int neon = 0;
    double blue = 0;
    double green = 0;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3) {
        blue += picture.rgb[i + 2];
        green += picture.rgb[i + 1];
        neon += picture.rgb[i] < 4 && picture.rgb[i + 1] > 200 && picture.rgb[i + 2] > 200 ? 1 : 0;
    }
    EXPECT_GT(blue, 1.2 * green);
    EXPECT_EQ(neon, 0);
}

// CIELAB without lightness, of the middle of a goldie's flank: so wide in the picture at any range.
glm::dvec2 goldieAt(float metres, const std::function<Picture(const Still&)>& pictureOf) {
    constexpr float kLength = 0.09F;
    Still still = openSea(6.0F);
    still.colourReturned = Still{}.colourReturned;
    still.camera.sizePixels = {160, 90};
    still.camera.heightDegrees = glm::degrees(2 * std::atan(0.5F * kLength / metres));
    still.fish = {portraitOf("sea_goldie", still.camera, metres, 0.0F, kLength)};
    const Picture picture = pictureOf(still);
    glm::dvec3 sum{0.0};
    for (int y = 40; y < 50; ++y)
        for (int x = 65; x < 95; ++x)
            for (int c = 0; c < 3; ++c)
                sum[c] += linearFromSrgb(picture.rgb[3 * static_cast<std::size_t>(y * 160 + x) +
                                                     static_cast<std::size_t>(c)] /
                                         255.0);
    const auto lab = labOf(sum / 300.0);
    return {lab[1], lab[2]};
}

// As the paper's reader sees a fish that nears the glass: it does not change its colour.
TEST_F(WaterPicture, aGoldieIsOrangeSixMetresAway) {
    const glm::dvec2 near = goldieAt(1.0F, pictureOf);
    const glm::dvec2 far = goldieAt(6.0F, pictureOf);
    const double cosine = glm::dot(near, far) / (glm::length(near) * glm::length(far));
    EXPECT_LT(glm::degrees(std::acos(std::min(cosine, 1.0))), 15.0)
        << near.x << " " << near.y << ", " << far.x << " " << far.y;
    EXPECT_GE(glm::length(far), 0.5 * glm::length(near));
}

// Of a picture's lower half, in HSV of its codes.
struct Hues {
    double outside = 0;  // the water's hues of 165 to 230 degrees, or nearly grey: shares of pixels
    double warm = 0;     // red to yellow
};

Hues huesOf(const Picture& picture) {
    Hues hues;
    const auto pixels = static_cast<std::size_t>(picture.sizePixels.x * picture.sizePixels.y);
    for (std::size_t i = pixels / 2; i < pixels; ++i) {
        const glm::dvec3 c{picture.rgb[3 * i], picture.rgb[3 * i + 1], picture.rgb[3 * i + 2]};
        const double most = std::max({c.r, c.g, c.b, 1.0});
        const double spread = most - std::min({c.r, c.g, c.b});
        const double hue =
            glm::degrees(std::atan2(std::sqrt(3.0) * (c.g - c.b), 2 * c.r - c.g - c.b));
        const double turned = hue < 0 ? hue + 360 : hue;
        const double saturation = spread / most;
        hues.outside += turned < 165 || turned > 230 || saturation < 0.2 ? 1 : 0;
        hues.warm += (turned < 70 || turned > 320) && saturation >= 0.12 ? 1 : 0;
    }
    hues.outside /= static_cast<double>(pixels - pixels / 2);
    hues.warm /= static_cast<double>(pixels - pixels / 2);
    return hues;
}

// About the eye of the reef, each eighth of a turn.
TEST_F(WaterPicture, aReefIsOchreRoseAndVioletAndNotAllTurquoise) {
    std::vector<double> outside, warm;
    for (int i = 0; i < 8; ++i) {
        Still still = reefIn(config::WaterType::IA);
        still.camera.azimuthDegrees = 45.0F * static_cast<float>(i);
        still.colourReturned = Still{}.colourReturned;
        const Hues hues = huesOf(pictureOf(still));
        outside.push_back(hues.outside);
        warm.push_back(hues.warm);
        EXPECT_GT(hues.outside, 0.20) << still.camera.azimuthDegrees;
    }
    std::ranges::sort(outside);
    std::ranges::sort(warm);
    EXPECT_GT(outside[4], 0.40);
    EXPECT_GT(warm[4], 0.12);
}

constexpr float kBetween = 24.0F;  // degrees, of two channels

// Where a picture shows a direction; empty within the passes' reach of its edge.
std::optional<glm::vec2> pixelOf(const Camera& camera, float azimuth, float elevation) {
    const scene::View view = viewOf(camera);
    const glm::vec3 direction{std::sin(glm::radians(azimuth)) * std::cos(glm::radians(elevation)),
                              std::sin(glm::radians(elevation)),
                              -std::cos(glm::radians(azimuth)) * std::cos(glm::radians(elevation))};
    const glm::vec4 clip =
        view.clipFromCamera * glm::mat4(glm::mat3(view.cameraFromWorld)) * glm::vec4(direction, 0);
    const glm::vec2 size(camera.sizePixels);
    const glm::vec2 pixel = (0.5F + 0.5F * glm::vec2(clip.x, -clip.y) / clip.w) * size;
    const float margin = 1.0F + shaders::kPostReach * view.clipFromCamera[1][1] * size.y;
    if (clip.w <= 0 || std::min(pixel.x, pixel.y) < margin || pixel.x > size.x - margin ||
        pixel.y > size.y - margin)
        return {};
    return pixel;
}

glm::dvec3 sampled(const Picture& picture, glm::vec2 pixel) {
    const glm::vec2 corner = glm::floor(pixel - 0.5F);
    const glm::dvec2 t(pixel - 0.5F - corner);
    const auto at = [&](int x, int y) {
        const std::size_t first =
            3 * static_cast<std::size_t>((static_cast<int>(corner.y) + y) * picture.sizePixels.x +
                                         static_cast<int>(corner.x) + x);
        return glm::dvec3(picture.rgb[first], picture.rgb[first + 1], picture.rgb[first + 2]);
    };
    return glm::mix(glm::mix(at(0, 0), at(1, 0), t.x), glm::mix(at(0, 1), at(1, 1), t.x), t.y);
}

// Means over blocks of 16 x 16 pixels. The passes read neighbours: were their margin too small, or
// were they sized in pixels of a channel, the overlap would show it.
TEST_F(WaterPicture, neighboursSoftenAlikeWhereTheyOverlap) {
    Still still = reefIn(config::WaterType::IA);
    still.camera.sizePixels = {320, 288};
    still.camera.heightDegrees = 50.0F;
    const auto towards = [&](float azimuth) {
        Still turned = still;
        turned.camera.azimuthDegrees = azimuth;
        return turned;
    };
    const Still left = towards(-kBetween / 2);
    const Still right = towards(kBetween / 2);
    const Picture leftPicture = pictureOf(left);
    const Picture rightPicture = pictureOf(right);
    constexpr float kBlockDegrees = 2.6F;
    constexpr int kSteps = 16;
    std::vector<double> codes;
    for (float azimuth = -12; azimuth < 10; azimuth += kBlockDegrees)
        for (float elevation = -20; elevation < 19; elevation += kBlockDegrees) {
            glm::dvec3 sum{0.0};
            int count = 0;
            for (int i = 0; i < kSteps * kSteps; ++i) {
                const int column = i % kSteps;
                const int row = i / kSteps;
                const float a = azimuth + kBlockDegrees * static_cast<float>(column) / kSteps;
                const float e = elevation + kBlockDegrees * static_cast<float>(row) / kSteps;
                const auto l = pixelOf(left.camera, a, e);
                const auto r = pixelOf(right.camera, a, e);
                if (!l || !r) continue;
                sum += sampled(leftPicture, *l) - sampled(rightPicture, *r);
                ++count;
            }
            if (count < kSteps * kSteps) continue;
            const glm::dvec3 mean = glm::abs(sum / static_cast<double>(count));
            codes.push_back(std::max({mean.r, mean.g, mean.b}));
        }
    ASSERT_GT(codes.size(), 60U);
    std::ranges::sort(codes);
    EXPECT_LT(codes[codes.size() / 2], 0.5);
    EXPECT_LT(codes[codes.size() * 9 / 10], 2.0);
}

}  // namespace
}  // namespace aquarama::test
