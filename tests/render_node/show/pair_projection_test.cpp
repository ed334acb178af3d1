// SPDX-License-Identifier: Apache-2.0
// Each packing of two eyes, pixel by pixel, against the eyes' own pictures.
#include <cmath>
#include <memory>
#include <vector>

#include <glm/mat3x3.hpp>
#include <gtest/gtest.h>

#include "common/wall/wall.h"
#include "render_node/gl/context.h"
#include "render_node/gl/handle.h"
#include "render_node/show/projection.h"
#include "tests/common/wall/rigs.h"

namespace aquarama::show {
namespace {

constexpr double kPairMargin = 0.01;
constexpr std::size_t kChannel = 2;
constexpr std::uint32_t kChannelId = 7;

// Those of a wall file, another at each pixel.
glm::vec3 blendAt(glm::vec2 share) {
    return {0.2F + 0.6F * share.x, 0.9F, 0.5F + 0.4F * share.y};
}
glm::vec3 blackAt(glm::vec2 share) {
    return {0.02F, 0.15F * share.x, 0.1F * share.y};
}

ProjectionMap withMasks(ProjectionMap map) {
    for (int y = 0; y < map.sizePixels.y; ++y)
        for (int x = 0; x < map.sizePixels.x; ++x) {
            const glm::vec2 share = glm::vec2(x, y) / glm::vec2(map.sizePixels);
            map.blend.push_back(blendAt(share));
            map.black.push_back(blackAt(share));
        }
    return map;
}

class PairProjectionTest : public testing::Test {
  protected:
    struct EyeStage {
        explicit EyeStage(const config::Rig& rig, wall::EyeSide side, float turn)
            : map{projectionMap(wall::Wall(rig).warp(kChannel),
                                wall::Wall(rig).frustum(kChannel, kPairMargin, side))},
              projection{map, kChannelId},
              masked{withMasks(map), kChannelId},
              scene{GL_RGBA16F, scenePictureSize(map)} {
            std::vector<float> rgb;
            for (int y = 0; y < scene.sizePixels().y; ++y)
                for (int x = 0; x < scene.sizePixels().x; ++x)
                    for (const float k : {0.013F, 0.031F, 0.0071F})
                        rgb.push_back(0.5F +
                                      0.4F * std::sin(k * static_cast<float>(x + 2 * y) + turn));
            glTextureSubImage2D(scene.texture(),
                                0,
                                0,
                                0,
                                scene.sizePixels().x,
                                scene.sizePixels().y,
                                GL_RGB,
                                GL_FLOAT,
                                rgb.data());
        }
        [[nodiscard]] PairProjection::Eye eye(bool hasMasks = false) const {
            return {scene.texture(), hasMasks ? masked : projection};
        }
        ProjectionMap map;
        Projection projection, masked;
        gl::Target scene;
    };

    // As light, before dither: 16 bits.
    [[nodiscard]] std::vector<std::uint16_t> packed(config::StereoMode mode,
                                                    bool hasMasks = false) const {
        const gl::Target target(GL_RGBA16, size_);
        PairProjection(size_, kChannelId, mode)
            .draw(left_.eye(hasMasks),
                  right_.eye(hasMasks),
                  {.framebuffer = target.framebuffer(), .frame = {}, .encoding = Encoding::Plain});
        return gl::readRgb<std::uint16_t>(target);
    }
    [[nodiscard]] std::vector<std::uint16_t> alone(const EyeStage& eye,
                                                   bool hasMasks = false) const {
        const gl::Target target(GL_RGBA16, size_);
        eye.eye(hasMasks).projection.draw({.sceneTexture = eye.scene.texture(),
                                           .framebuffer = target.framebuffer(),
                                           .frame = {},
                                           .encoding = Encoding::Plain});
        return gl::readRgb<std::uint16_t>(target);
    }
    // Of an eye at a pixel of its picture with the masks, from its picture without.
    [[nodiscard]] glm::dvec3 masked(glm::dvec3 light, int x, int y) const {
        const glm::vec2 share = glm::vec2(x, y) / glm::vec2(size_);
        const glm::dvec3 black(blackAt(share));
        return glm::min(light * glm::dvec3(blendAt(share)), 1.0) * (1.0 - black) + black;
    }
    [[nodiscard]] glm::dvec3 lightAt(const std::vector<std::uint16_t>& codes, int x, int y) const {
        const auto at = static_cast<std::size_t>(y * size_.x + x) * 3;
        const auto linear = [](std::uint16_t code) {
            const double value = code / 65535.0;
            return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
        };
        return {linear(codes[at]), linear(codes[at + 1]), linear(codes[at + 2])};
    }

    std::unique_ptr<gl::Context> context_ = gl::makeOffscreenContext("auto", {480, 360});
    config::Rig rig_ = wall::shippedRig("desk_stereo");
    glm::ivec2 size_ = rig_.channels[kChannel].sizePixels;
    EyeStage left_{rig_, wall::EyeSide::Left, 0.0F};
    EyeStage right_{rig_, wall::EyeSide::Right, 1.5F};
};

void expectNear(glm::dvec3 one, glm::dvec3 other, int x, int y) {
    for (int c = 0; c < 3; ++c) ASSERT_NEAR(one[c], other[c], 1e-4) << x << ", " << y;
}

TEST_F(PairProjectionTest, halvesBesideOneAnotherAreTheMeansOfTwoColumns) {
    const auto both = packed(config::StereoMode::SideBySide);
    const auto left = alone(left_);
    const auto right = alone(right_);
    for (int y = 0; y < size_.y; y += 7)
        for (int x = 0; x < size_.x / 2; ++x)
            for (const bool isRight : {false, true}) {
                const auto& own = isRight ? right : left;
                const glm::dvec3 mean = 0.5 * (lightAt(own, 2 * x, y) + lightAt(own, 2 * x + 1, y));
                expectNear(lightAt(both, x + (isRight ? size_.x / 2 : 0), y), mean, x, y);
            }
}

TEST_F(PairProjectionTest, halvesAboveOneAnotherAreTheMeansOfTwoRows) {
    const auto both = packed(config::StereoMode::TopBottom);
    const auto left = alone(left_);
    const auto right = alone(right_);
    for (int y = 0; y < size_.y / 2; y += 5)
        for (int x = 0; x < size_.x; ++x)
            for (const bool isRight : {false, true}) {
                const auto& own = isRight ? right : left;
                const glm::dvec3 mean = 0.5 * (lightAt(own, x, 2 * y) + lightAt(own, x, 2 * y + 1));
                expectNear(lightAt(both, x, y + (isRight ? size_.y / 2 : 0)), mean, x, y);
            }
}

TEST_F(PairProjectionTest, rowsTakeTurnsFromTheLeftEyeOn) {
    const auto both = packed(config::StereoMode::Interlaced);
    const auto left = alone(left_);
    const auto right = alone(right_);
    const auto width = static_cast<std::size_t>(size_.x) * 3;
    for (std::size_t i = 0; i < both.size(); ++i)
        ASSERT_EQ(both[i], (i / width) % 2 == 0 ? left[i] : right[i]) << "row " << i / width;
}

// For red and cyan glasses (Dubois 2001).
glm::dvec3 forGlasses(glm::dvec3 left, glm::dvec3 right) {
    const glm::dmat3 toRed = glm::transpose(glm::dmat3(0.4561,
                                                       0.500484,
                                                       0.176381,
                                                       -0.0400822,
                                                       -0.0378246,
                                                       -0.0157589,
                                                       -0.0152161,
                                                       -0.0205971,
                                                       -0.00546856));
    const glm::dmat3 toCyan = glm::transpose(glm::dmat3(-0.0434706,
                                                        -0.0879388,
                                                        -0.00155529,
                                                        0.378476,
                                                        0.73364,
                                                        -0.0184503,
                                                        -0.0721527,
                                                        -0.112961,
                                                        1.2264));
    return glm::max(toRed * left + toCyan * right, 0.0);
}

TEST_F(PairProjectionTest, redAndCyanAreDuboisLeastSquares) {
    const auto both = packed(config::StereoMode::Anaglyph);
    const auto left = alone(left_);
    const auto right = alone(right_);
    for (int y = 0; y < size_.y; y += 7)
        for (int x = 0; x < size_.x; x += 3) {
            const glm::dvec3 light = forGlasses(lightAt(left, x, y), lightAt(right, x, y));
            expectNear(lightAt(both, x, y), glm::min(light, 1.0), x, y);
        }
}

TEST_F(PairProjectionTest, aWallFilesMasksLieOnThePictureOfEachEye) {
    using enum config::StereoMode;
    for (const EyeStage* eye : {&left_, &right_}) {
        const auto plain = alone(*eye), own = alone(*eye, true);
        for (int y = 0; y < size_.y; y += 7)
            for (int x = 0; x < size_.x; ++x)
                expectNear(lightAt(own, x, y), masked(lightAt(plain, x, y), x, y), x, y);
    }
    const auto left = alone(left_, true), right = alone(right_, true);
    const auto beside = packed(SideBySide, true), above = packed(TopBottom, true);
    const auto rows = packed(Interlaced, true);
    const glm::ivec2 half = size_ / 2;
    for (int y = 0; y < half.y; y += 5)
        for (int x = 0; x < half.x; x += 3)
            for (const bool isRight : {false, true}) {
                const auto& own = isRight ? right : left;
                const auto at = [&](int ownX, int ownY) { return lightAt(own, ownX, ownY); };
                expectNear(lightAt(beside, x + (isRight ? half.x : 0), y),
                           0.5 * (at(2 * x, y) + at(2 * x + 1, y)),
                           x,
                           y);
                expectNear(lightAt(above, x, y + (isRight ? half.y : 0)),
                           0.5 * (at(x, 2 * y) + at(x, 2 * y + 1)),
                           x,
                           y);
                const int row = 2 * y + (isRight ? 1 : 0);
                expectNear(lightAt(rows, x, row), at(x, row), x, row);
            }
}

// What the glasses let through is mixed before the display lends it its own black and colours.
TEST_F(PairProjectionTest, aWallFilesMasksLieOnTheMixOfRedAndCyan) {
    const auto both = packed(config::StereoMode::Anaglyph, true);
    const auto left = alone(left_), right = alone(right_);
    for (int y = 0; y < size_.y; y += 7)
        for (int x = 0; x < size_.x; x += 3)
            expectNear(lightAt(both, x, y),
                       masked(forGlasses(lightAt(left, x, y), lightAt(right, x, y)), x, y),
                       x,
                       y);
}

// Else its grain would hang in the room at a depth of its own.
TEST_F(PairProjectionTest, theDitherIsTheSameForBothEyes) {
    const gl::Target target(GL_RGBA8, size_);
    for (const config::StereoMode mode :
         {config::StereoMode::SideBySide, config::StereoMode::TopBottom}) {
        PairProjection(size_, kChannelId, mode)
            .draw(left_.eye(), left_.eye(), {.framebuffer = target.framebuffer(), .frame = {}});
        const auto codes = gl::readRgb<std::uint8_t>(target);
        const glm::ivec2 half = mode == config::StereoMode::SideBySide ? glm::ivec2(size_.x / 2, 0)
                                                                       : glm::ivec2(0, size_.y / 2);
        for (int y = 0; y < size_.y - half.y; ++y)
            for (int x = 0; x < 3 * (size_.x - half.x); ++x) {
                const auto at = static_cast<std::size_t>(y * size_.x * 3 + x);
                const auto other =
                    static_cast<std::size_t>((y + half.y) * size_.x * 3 + x + 3 * half.x);
                if (half.x > 0 && x >= 3 * half.x) continue;
                ASSERT_EQ(codes[at], codes[other]);
            }
    }
}

TEST(PixelOfEye, isTheSamePlaceOfTheScreenInBothHalves) {
    constexpr glm::ivec2 kSize(480, 360);
    using enum config::StereoMode;
    EXPECT_EQ(pixelOfEye(SideBySide, kSize, {60, 90}), glm::vec2(120, 90));
    EXPECT_EQ(pixelOfEye(SideBySide, kSize, {300, 90}), glm::vec2(120, 90));
    EXPECT_EQ(pixelOfEye(TopBottom, kSize, {60, 90}), glm::vec2(60, 180));
    EXPECT_EQ(pixelOfEye(TopBottom, kSize, {60, 270}), glm::vec2(60, 180));
    for (const config::StereoMode whole : {Mono, QuadBuffer, Interlaced, Anaglyph})
        EXPECT_EQ(pixelOfEye(whole, kSize, {60, 90}), glm::vec2(60, 90));
}

}  // namespace
}  // namespace aquarama::show
