// SPDX-License-Identifier: Apache-2.0
#include "render_node/show/projection.h"

#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "render_node/gl/context.h"
#include "render_node/gl/handle.h"
#include "tests/common/wall/rigs.h"
#include "tests/render_node/show/reference.h"

namespace aquarama::show {
namespace {

constexpr double kMarginRadians = 0.01;

// One channel of the desk, with a picture to project.
class ProjectionTest : public testing::Test {
  protected:
    void show(const std::vector<float>& rgbTopRowFirst) {
        light_ = {sceneSize_, rgbTopRowFirst};
        std::vector<float> bottomRowFirst;
        for (int y = sceneSize_.y - 1; y >= 0; --y) {
            const auto row = rgbTopRowFirst.begin() + std::ptrdiff_t{y} * sceneSize_.x * 3;
            bottomRowFirst.insert(
                bottomRowFirst.end(), row, row + std::ptrdiff_t{3} * sceneSize_.x);
        }
        glTextureSubImage2D(scene_.texture(),
                            0,
                            0,
                            0,
                            sceneSize_.x,
                            sceneSize_.y,
                            GL_RGB,
                            GL_FLOAT,
                            bottomRowFirst.data());
        light_.rgb = gl::readRgb<float>(scene_);  // as half floats hold it
    }
    void showFlat(float level) {
        show(std::vector<float>(static_cast<std::size_t>(sceneSize_.x * sceneSize_.y) * 3, level));
    }
    // Smooth waves from black to full white and over it, another for each colour.
    void showWaves() {
        std::vector<float> rgb;
        for (int y = 0; y < sceneSize_.y; ++y)
            for (int x = 0; x < sceneSize_.x; ++x)
                for (const float k : {0.013F, 0.031F, 0.0071F})
                    rgb.push_back(0.55F + 0.6F * std::sin(k * static_cast<float>(x + 2 * y)));
        show(rgb);
    }
    template <class Sample>
    std::vector<Sample> project(GLenum format, Encoding encoding, std::uint64_t frame = 0) {
        const gl::Target target(format, map_.sizePixels);
        Projection(map_, kChannelId)
            .draw({.sceneTexture = scene_.texture(),
                   .framebuffer = target.framebuffer(),
                   .frame = {frame},
                   .encoding = encoding});
        return gl::readRgb<Sample>(target);
    }

    static constexpr std::uint32_t kChannelId = 5;
    std::unique_ptr<gl::Context> context_ = gl::makeOffscreenContext("auto", {480, 360});
    config::Rig rig_ = wall::shippedRig("desk");
    ProjectionMap map_ =
        projectionMap(wall::Wall(rig_).warp(0), wall::Wall(rig_).frustum(0, kMarginRadians));
    glm::ivec2 sceneSize_ = scenePictureSize(map_);
    gl::Target scene_{GL_RGBA16F, sceneSize_};
    LightPicture light_;
};

TEST_F(ProjectionTest, everyPixelIsTheReferencesWithinACode) {
    showWaves();
    const auto pixels = project<std::uint8_t>(GL_RGBA8, Encoding::Dithered8, 3);
    const auto width = static_cast<std::size_t>(map_.sizePixels.x);
    std::size_t different = 0;
    for (std::size_t i = 0; i < map_.placeAndWeight.size(); ++i) {
        const glm::dvec3 light = projectedLight(map_, light_, i);
        const auto random = pcg3d(static_cast<std::uint32_t>(i % width),
                                  static_cast<std::uint32_t>(i / width),
                                  kChannelId * 2 + 1);
        for (int c = 0; c < 3; ++c) {
            const auto sample = static_cast<std::size_t>(c);
            const int expected = ditheredCode(srgbOf(light[c]), random[sample]);
            const int difference = std::abs(pixels[3 * i + sample] - expected);
            ASSERT_LE(difference, 1) << "pixel " << i % width << ", " << i / width;
            different += difference != 0;
        }
    }
    EXPECT_LT(different, pixels.size() / 100) << "more than rounding differs";
}

TEST_F(ProjectionTest, sixteenBitsFollowTheExactCurve) {
    showWaves();
    const auto pixels = project<std::uint16_t>(GL_RGBA16, Encoding::Plain);
    double worst = 0;
    for (std::size_t i = 0; i < map_.placeAndWeight.size(); ++i) {
        const glm::dvec3 light = projectedLight(map_, light_, i);
        for (int c = 0; c < 3; ++c)
            worst = std::max(
                worst,
                std::abs(pixels[3 * i + static_cast<std::size_t>(c)] - 65535 * srgbOf(light[c])));
    }
    EXPECT_LT(worst, 2);
}

TEST_F(ProjectionTest, flatGreyKeepsItsValue) {
    for (const float level : {0.001F, 0.01F, 0.18F, 0.5F, 1.0F}) {
        showFlat(level);
        const auto pixels = project<std::uint16_t>(GL_RGBA16, Encoding::Plain);
        for (std::size_t i = 0; i < map_.placeAndWeight.size(); ++i) {
            const double weight = static_cast<double>(map_.placeAndWeight[i].z);
            const double expected = 65535 * srgbOf(static_cast<double>(light_.rgb[0]) * weight);
            ASSERT_NEAR(pixels[3 * i], expected, 6) << "level " << level << ", weight " << weight;
        }
    }
}

TEST_F(ProjectionTest, ditherIsRightInTheMean) {
    for (const double code : {0.0, 0.3, 0.7, 10.5, 200.25, 254.8, 255.0}) {
        const double value = code / 255;
        const double linear =
            value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
        showFlat(static_cast<float>(linear));
        const auto pixels = project<std::uint8_t>(GL_RGBA8, Encoding::Dithered8);
        double sum = 0;
        double expected = 0;
        double count = 0;
        for (std::size_t i = 0; i < map_.placeAndWeight.size(); ++i) {
            if (map_.placeAndWeight[i].z < 1) continue;
            ++count;
            sum += pixels[3 * i];
            expected += 255 * srgbOf(static_cast<double>(light_.rgb[0]));
        }
        ASSERT_GT(count, 20000);
        // The mean of that many pixels scatters by 0.5 / sqrt(count), a standard deviation.
        EXPECT_NEAR(sum / count, expected / count, 4 * 0.5 / std::sqrt(count)) << "code " << code;
    }
}

TEST_F(ProjectionTest, ditherHasItsOwnSeedPerChannelAndParity) {
    showFlat(0.2F);
    const auto even = project<std::uint8_t>(GL_RGBA8, Encoding::Dithered8, 4);
    EXPECT_EQ(even, project<std::uint8_t>(GL_RGBA8, Encoding::Dithered8, 2));
    EXPECT_NE(even, project<std::uint8_t>(GL_RGBA8, Encoding::Dithered8, 3));
    const gl::Target target(GL_RGBA8, map_.sizePixels);
    Projection(map_, kChannelId + 1)
        .draw(
            {.sceneTexture = scene_.texture(), .framebuffer = target.framebuffer(), .frame = {4}});
    EXPECT_NE(even, gl::readRgb<std::uint8_t>(target));
}

TEST_F(ProjectionTest, theBlendMaskIsTheBlendAlone) {
    showFlat(0.0F);
    const gl::Target target(GL_RGBA16, map_.sizePixels);
    Projection(map_, kChannelId)
        .draw({.sceneTexture = scene_.texture(),
               .framebuffer = target.framebuffer(),
               .frame = {},
               .encoding = Encoding::Plain,
               .blendMask = true});
    const auto pixels = gl::readRgb<std::uint16_t>(target);
    for (std::size_t i = 0; i < map_.placeAndWeight.size(); ++i) {
        const double weight = static_cast<double>(map_.placeAndWeight[i].z);
        ASSERT_NEAR(pixels[3 * i], 65535 * srgbOf(weight), 6);
    }
}

}  // namespace
}  // namespace aquarama::show
