// SPDX-License-Identifier: Apache-2.0
// What waves, shafts and shadows do to the light: on software GL, read back as numbers.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <span>
#include <vector>

#include <epoxy/gl.h>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

#include "common/place/place.h"
#include "render_node/gl/context.h"
#include "render_node/gl/program.h"
#include "render_node/reef/mesh.h"
#include "render_node/reef/solid_array.h"
#include "render_node/scene/sea_light.h"
#include "render_node/shaders/frame_uniforms.h"
#include "tests/support/golden_stills.h"

namespace aquarama::scene {
namespace {

constexpr float kFilterDepthMetres = 4.9F;

class Sunlight : public testing::Test {
  protected:
    static void SetUpTestSuite() { context() = gl::makeOffscreenContext("auto", {16, 16}); }
    static void TearDownTestSuite() { context().reset(); }
    static std::unique_ptr<gl::Context>& context() {
        static std::unique_ptr<gl::Context> instance;
        return instance;
    }

    Sunlight() {
        uniforms_.eyeAndTime = glm::vec4(place::kEyePosition, 0.0F);
        uniforms_.sharedEyeAndPixel = glm::vec4(place::kEyePosition, 0.002F);
        uniforms_.sunAndFilterDepth = glm::vec4(sunInWater(), kFilterDepthMetres);
        uniforms_.sunlight = glm::vec4(1.0F);
        uniforms_.skylight = glm::vec4(1.0F);
        glNamedBufferStorage(
            block_.name(), sizeof(shaders::FrameUniforms), nullptr, GL_DYNAMIC_STORAGE_BIT);
        setUniforms();
    }
    void setUniforms() const {
        glNamedBufferSubData(block_.name(), 0, sizeof(uniforms_), &uniforms_);
        glBindBufferBase(GL_UNIFORM_BUFFER, 0, block_.name());
    }

    shaders::FrameUniforms uniforms_{};
    gl::Buffer block_;
};

std::vector<float> texelsOf(const gl::Texture& texture, GLenum format, int values, int level = 0) {
    std::vector<float> texels(static_cast<std::size_t>(values));
    glGetTextureImage(texture.name(),
                      level,
                      format,
                      GL_FLOAT,
                      static_cast<GLsizei>(texels.size() * sizeof(float)),
                      texels.data());
    return texels;
}

// Looks along a direction, 120 degrees across.
glm::mat4 clipTowards(glm::vec3 direction, glm::vec3 up) {
    glm::mat4 clip{0.0F};
    clip[0][0] = clip[1][1] = 1.0F / std::tan(glm::radians(60.0F));
    clip[2][3] = -1.0F;
    clip[3][2] = 0.01F;
    return clip * glm::lookAt(glm::vec3{0.0F}, direction, up);
}

// A small target for one program of the scene, as its float values.
class Canvas {
  public:
    explicit Canvas(int side)
        : side_{side}, texture_{makeTexture(GL_RGBA32F, glm::ivec2{side}, 1, Edge::Clamp)} {}
    void begin() const {
        glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
        glViewport(0, 0, side_, side_);
        glDisable(GL_DEPTH_TEST);
        glClearColor(0, 0, 0, 0);
        glClear(GL_COLOR_BUFFER_BIT);
        glBindVertexArray(empty_.name());
    }
    [[nodiscard]] std::vector<float> rgb() const {
        return texelsOf(texture_, GL_RGB, 3 * side_ * side_);
    }

  private:
    int side_;
    gl::Texture texture_;
    gl::Framebuffer target_ = makeTarget(texture_);
    gl::VertexArray empty_;
};

double meanOf(std::span<const float> values) {
    double sum = 0;
    for (const float value : values) sum += static_cast<double>(value);
    return sum / static_cast<double>(values.size());
}

// At every depth at which it is drawn.
TEST_F(Sunlight, wavesGatherLightAndMakeNone) {
    const LightQuality quality{.causticLayers = 4, .causticTexels = 256, .causticCells = 120};
    SeaLight light{{.quality = quality}};
    for (const double time : {0.0, 2.7, 1000.3}) {
        light.update(time, place::kEyePosition);
        const int texels = quality.causticTexels * quality.causticTexels;
        const std::vector<float> all =
            texelsOf(light.causticLayers(), GL_RED, texels * quality.causticLayers);
        for (int layer = 0; layer < quality.causticLayers; ++layer) {
            const auto net = std::span(all).subspan(static_cast<std::size_t>(layer * texels),
                                                    static_cast<std::size_t>(texels));
            EXPECT_NEAR(meanOf(net), 1.0, 0.05) << time << " s, layer " << layer;
            EXPECT_GT(*std::ranges::max_element(net), layer == 0 ? 1.3F : 3.0F) << "no net";
        }
    }
}

// Between a shimmer too quick to follow and a net that stands still; at the scale of its meshes.
TEST_F(Sunlight, theNetOfLightMovesWithinASecond) {
    constexpr int kLevel = 2;  // texels of 19 cm
    const LightQuality quality;
    SeaLight light{{.quality = quality}};
    const auto netAt = [&](double time) {
        light.update(time, place::kEyePosition);
        const int side = quality.causticTexels >> kLevel;
        std::vector<float> net = texelsOf(light.causticLayers(), GL_RED, side * side, kLevel);
        for (float& value : net) value -= 1.0F;
        return net;
    };
    const std::vector<float> start = netAt(20.0);
    const auto alike = [&](double later) {
        const std::vector<float> net = netAt(20.0 + later);
        return std::inner_product(net.begin(), net.end(), start.begin(), 0.0) /
               std::inner_product(start.begin(), start.end(), start.begin(), 0.0);
    };
    EXPECT_GT(alike(1.0 / 60.0), 0.9);
    EXPECT_GT(alike(0.15), 0.37);
    EXPECT_LT(alike(0.8), 0.37);
}

// Of an octahedral map with a border of one texel: its mean over the sphere.
glm::dvec4 meanOverSphere(std::span<const float> map, int texels) {
    glm::dvec4 sum{0.0};
    double whole = 0;
    for (int row = 1; row + 1 < texels; ++row)
        for (int column = 1; column + 1 < texels; ++column) {
            // A texel's solid angle: one over the cube of its distance on the octahedron.
            const glm::dvec2 p = glm::abs(2.0 * (glm::dvec2{column, row} + 0.5 - texels / 2.0)) /
                                 static_cast<double>(texels - 2);
            const double z = 1.0 - p.x - p.y;
            const glm::dvec2 folded = z < 0 ? 1.0 - glm::dvec2{p.y, p.x} : p;
            const double solid = std::pow(glm::length(glm::dvec3{folded, z}), -3.0);
            const float* texel = &map[4 * static_cast<std::size_t>(row * texels + column)];
            sum += solid * glm::dvec4{texel[0], texel[1], texel[2], texel[3]};
            whole += solid;
        }
    return sum / whole;
}

// What they add somewhere they take away elsewhere: here there is more of the net, there less, so
// some times and places are taken together.
TEST_F(Sunlight, shaftsMakeNoLight) {
    constexpr int kTimes = 8;
    const LightQuality quality;
    SeaLight light{{.quality = quality}};
    const int texels = quality.shaftTexels;
    glm::dvec4 mean{0.0};
    for (int i = 0; i < kTimes; ++i) {
        const glm::vec3 eye =
            place::kEyePosition + glm::vec3{3.7F, 0.0F, 2.3F} * static_cast<float>(i);
        uniforms_.eyeAndTime = glm::vec4(eye, 0.0F);
        setUniforms();
        light.update(1.7 * i, eye);
        for (const glm::vec3 axis : {glm::vec3{1, 0, 0}, glm::vec3{0, 1, 0}, glm::vec3{0, 0, 1}})
            for (const float side : {-1.0F, 1.0F})
                light.drawShafts(
                    eye,
                    glm::inverse(clipTowards(side * axis, glm::vec3{axis.z, axis.x, axis.y}) *
                                 glm::translate(glm::mat4{1.0F}, -eye)));
        mean += meanOverSphere(texelsOf(light.shaftMap(), GL_RGBA, 4 * texels * texels), texels) /
                static_cast<double>(kTimes);
    }
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(mean[i], 1.0, 0.03) << "range " << i;
}

// Straight up through water without a wave, and across from there: where total reflection begins,
// and how bright the sky is.
TEST_F(Sunlight, theWindowOfACalmSeaEndsAtTheCriticalAngle) {
    constexpr int kSide = 512;
    const glm::vec3 eye{0.0F, -0.5F, 0.0F};
    uniforms_.clipFromWorld =
        clipTowards({0, 1, 0}, {0, 0, 1}) * glm::translate(glm::mat4{1.0F}, -eye);
    uniforms_.eyeAndTime = glm::vec4(eye, 0.0F);
    uniforms_.sharedEyeAndPixel = glm::vec4(eye, 1.0e-4F);
    uniforms_.sunAndFilterDepth.w = 0.0F;
    uniforms_.sunlight = glm::vec4(0.0F);  // the sky alone
    setUniforms();
    SeaLight light{{.quality = {}, .calm = true}};
    light.update(0.0, eye);
    light.bind();
    const Canvas canvas{kSide};
    canvas.begin();
    const gl::ProgramHandle surface = gl::makeProgram({"water_surface.vert", "water_surface.frag"});
    glUseProgram(surface.name());
    glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    const std::vector<float> rgb = canvas.rgb();
    const auto blue = [&](int column) {
        return rgb[3 * static_cast<std::size_t>(kSide / 2 * kSide + column) + 2];
    };
    int edge = kSide / 2;
    for (int column = kSide / 2; column + 1 < kSide; ++column)
        if (blue(column) - blue(column + 1) > blue(edge) - blue(edge + 1)) edge = column;
    const double across = (edge + 1.0 - kSide / 2.0) / (kSide / 2.0) * std::tan(glm::radians(60.0));
    EXPECT_NEAR(glm::degrees(std::atan(across)), 48.3, 0.5);
    // Zenith as in sky.glsl; Fresnel at normal incidence; n squared.
    const double entering = 1.0 - std::pow(0.34 / 2.34, 2);
    EXPECT_NEAR(static_cast<double>(blue(kSide / 2)) / (0.054 * entering * 1.34 * 1.34), 1.0, 0.08);
}

// A box that follows the eye: specks come and go at its faces, where they have faded.
TEST_F(Sunlight, snowComesAndGoesWithoutPopping) {
    const Canvas canvas{128};
    SeaLight light{{}};
    light.update(3.0, place::kEyePosition);
    const gl::ProgramHandle snow = gl::makeProgram({"snow.vert", "snow.frag"});
    const auto lightFrom = [&](glm::vec3 eye) {
        uniforms_.clipFromWorld =
            clipTowards({0, 0, -1}, {0, 1, 0}) * glm::translate(glm::mat4{1.0F}, -eye);
        uniforms_.eyeAndTime = glm::vec4(eye, 3.0F);
        uniforms_.sharedEyeAndPixel = glm::vec4(eye, 0.016F);
        uniforms_.viewport = {128.0F, 128.0F, 128.0F, 64.0F / std::tan(glm::radians(60.0F))};
        setUniforms();
        light.bind();
        canvas.begin();
        glEnable(GL_BLEND);
        glBlendFunc(GL_ONE, GL_ONE);
        glEnable(GL_PROGRAM_POINT_SIZE);
        glUseProgram(snow.name());
        glDrawArrays(GL_POINTS, 0, 9000);
        glDisable(GL_BLEND);
        return meanOf(canvas.rgb());
    };
    double before = lightFrom(place::kEyePosition);
    ASSERT_GT(before, 0.0);
    for (int step = 1; step <= 30; ++step) {
        const double now = lightFrom(place::kEyePosition + glm::vec3{0.0007F, 0.0002F, -0.0007F} *
                                                               static_cast<float>(step));
        EXPECT_NEAR(now / before, 1.0, 0.02) << step;
        before = now;
    }
}

// Seen from straight above its shadow, the fish being out of the picture.
TEST_F(Sunlight, aFishThrowsAShadowOnTheSand) {
    test::Still still;
    still.options.quality = config::QualityTier::Medium;
    still.camera = {{0.0F, -6.0F, 1.5F}, 0.0F, -89.0F, 24.0F, {64, 64}};
    const auto shown = [&] {
        const Picture picture = test::pictureOf(still);
        double sum = 0;
        for (int y = 24; y < 40; ++y)
            for (int x = 24; x < 40; ++x)
                sum += picture.rgb[3 * static_cast<std::size_t>(y * 64 + x) + 1];
        return sum;
    };
    const double open = shown();
    const glm::vec3 sun = sunInWater();
    const glm::vec3 sand{0.0F, place::floorHeight({1}, {0.0F, 1.5F}), 1.5F};
    const glm::vec3 fish = sand + sun * 2.0F;
    still.fish.push_back({"bigeye_scad", fish, {1, 0, 0, 0}, 1.2F, 0.0F});
    EXPECT_LT(shown(), 0.9 * open);
}

TEST_F(Sunlight, looksAsItDidFromBelowAndASchoolShadesItself) {
    for (const test::GoldenStill& golden : test::goldenStills("surface/"))
        test::expectGolden(test::pictureOf(golden.still), golden.name, golden.limits);
}

}  // namespace
}  // namespace aquarama::scene
