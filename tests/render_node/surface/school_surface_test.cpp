// SPDX-License-Identifier: Apache-2.0
#include "render_node/surface/school_surface.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <span>
#include <vector>

#include <epoxy/gl.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <gtest/gtest.h>

#include "common/skin/limit_table.h"
#include "render_node/context/context.h"
#include "render_node/gl/handle.h"
#include "render_node/surface/skin_programs.h"
#include "tests/render_node/surface/test_fish.h"

namespace aquarama {
namespace {

// A camera at the origin; reversed depth, zero to one.
glm::mat4 clipFromCamera(float verticalRadians, float aspect) {
    constexpr float kNear = 0.05F;
    const float f = 1.0F / std::tan(verticalRadians / 2);
    glm::mat4 clip{0.0F};
    clip[0][0] = f / aspect;
    clip[1][1] = f;
    clip[2][3] = -1.0F;
    clip[3][2] = kNear;
    return clip;
}

glm::quat anyRotation(std::mt19937& random) {
    std::normal_distribution<float> normal;
    return glm::normalize(
        glm::quat(normal(random), normal(random), normal(random), normal(random)));
}

class SchoolSurfaceTest : public testing::Test {
  protected:
    static void SetUpTestSuite() { context() = makeOffscreenContext("mesa", {64, 64}); }
    static void TearDownTestSuite() { context().reset(); }
    static std::unique_ptr<Context>& context() {
        static std::unique_ptr<Context> one;
        return one;
    }

    // Positions of the first vertices in the surface buffer, which update() leaves bound.
    static std::vector<glm::vec3> surfacePositions(std::size_t count, std::size_t first = 0) {
        int buffer = 0;
        glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, 4, &buffer);
        std::vector<glm::vec4> vertices(count);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        glGetNamedBufferSubData(static_cast<GLuint>(buffer),
                                static_cast<GLintptr>(first * sizeof(glm::vec4)),
                                static_cast<GLsizeiptr>(count * sizeof(glm::vec4)),
                                vertices.data());
        return {vertices.begin(), vertices.end()};
    }

    // The same on the CPU: eq. 13, then the stencils that limit_table_test holds against
    // OpenSubdiv's refinement.
    [[nodiscard]] std::vector<glm::vec3> expectedPositions(const PresentedFish& fish,
                                                           int level) const {
        std::vector<glm::vec3> cage(kControlPoints);
        controlPoints(repertoire_, fish, cage);
        const LimitTable table = makeLimitTable(body_, level);
        std::vector<glm::vec3> positions(table.vertices.size());
        for (std::size_t i = 0; i < positions.size(); ++i) {
            for (std::uint32_t k = table.firstEntry[i]; k < table.firstEntry[i + 1]; ++k)
                positions[i] += table.entries[k].position * cage[table.entries[k].controlPoint];
        }
        return positions;
    }

    static float largestDistance(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
        float largest = a.size() == b.size() ? 0.0F : INFINITY;
        for (std::size_t i = 0; i < a.size(); ++i)
            largest = std::max(largest, glm::distance(a[i], b.at(i)));
        return largest;
    }

    static int levelOf(const SurfaceCounts& counts) {
        return counts.perLevel[0] == 1 ? 0 : counts.perLevel[1] == 1 ? 1 : 2;
    }

    const FishBody body_ = test::scad();
    const Repertoire repertoire_ = test::swaying(body_, 0.12F);
    const glm::mat4 clip_ = clipFromCamera(1.0F, 1.5F);
};

TEST_F(SchoolSurfaceTest, everyLevelLiesWhereTheCpuPutsIt) {
    SchoolSurface surface{body_, repertoire_, {}, makeSkinPrograms()};
    std::mt19937 random{7};
    std::uniform_real_distribution<float> unit;
    bool levelSeen[3] = {};
    for (int trial = 0; trial < 30; ++trial) {
        PresentedFish fish =
            test::fishAt({0, 0, -0.3F - 0.15F * static_cast<float>(trial)}, anyRotation(random));
        fish.phase = unit(random);
        fish.fromPhase = unit(random);
        fish.segment = static_cast<std::uint32_t>(trial % kActions);
        fish.fromSegment = static_cast<std::uint32_t>(trial % 3);
        fish.warpWeight = trial % 2 == 0 ? 1.0F : unit(random);
        surface.update({&fish, 1}, clip_, glm::vec3{0});
        const int level = levelOf(surface.counts());
        levelSeen[level] = true;
        const auto expected = expectedPositions(fish, level);
        EXPECT_LT(largestDistance(surfacePositions(expected.size()), expected),
                  1e-4F * fish.lengthMetres)
            << "level " << level;
    }
    EXPECT_TRUE(levelSeen[0] && levelSeen[1] && levelSeen[2]);
}

TEST_F(SchoolSurfaceTest, noFishInSightIsCulled) {
    SchoolSurface surface{body_, repertoire_, {}, makeSkinPrograms()};
    std::mt19937 random{11};
    std::uniform_real_distribution<float> unit{-1.0F, 1.0F};
    std::vector<glm::vec3> points(kControlPoints);
    int inSight = 0, culled = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const glm::mat4 view = glm::mat4_cast(anyRotation(random));
        const glm::mat4 clipFromWorld = clip_ * view;
        const glm::vec3 ahead = glm::inverse(view) * glm::vec4(0, 0, -1.2F, 0);
        PresentedFish fish = test::fishAt(
            ahead + glm::vec3{unit(random), unit(random), unit(random)}, anyRotation(random));
        fish.phase = 0.5F + 0.49F * unit(random);
        fish.segment = static_cast<std::uint32_t>(trial % kActions);
        controlPoints(repertoire_, fish, points);
        const bool isInSight = std::ranges::any_of(points, [&](glm::vec3 point) {
            const glm::vec4 clip = clipFromWorld * glm::vec4(point, 1);
            return std::abs(clip.x) < clip.w && std::abs(clip.y) < clip.w && clip.z > 0 &&
                   clip.z < clip.w;
        });
        surface.update({&fish, 1}, clipFromWorld, glm::vec3{0});
        inSight += isInSight ? 1 : 0;
        culled += 1 - surface.counts().visible;
        if (isInSight) {
            ASSERT_EQ(surface.counts().visible, 1) << "trial " << trial;
        }
    }
    EXPECT_GT(inSight, 200);  // else the test would have proved nothing
    EXPECT_GT(culled, 200);
}

TEST_F(SchoolSurfaceTest, neighbouringChannelsChooseTheSameLevel) {
    SchoolSurface left{body_, repertoire_, {}, makeSkinPrograms()};
    SchoolSurface right{body_, repertoire_, {}, makeSkinPrograms()};
    const glm::vec3 up{0, 1, 0}, eye{0.1F, 0.2F, 0.3F};
    // One channel looks from the shared eye, the other from beside it and with a longer lens.
    const glm::mat4 leftClip = clip_ * glm::lookAt(eye, eye + glm::vec3{-0.3F, 0, -1}, up);
    const glm::mat4 rightClip =
        clipFromCamera(0.6F, 1.0F) *
        glm::lookAt(eye + glm::vec3{0.3F, 0, 0}, eye + glm::vec3{-0.1F, 0, -1}, up);
    int compared = 0;
    for (int step = 0; step < 150; ++step) {
        const float away = 0.3F + 0.05F * static_cast<float>(step);
        const PresentedFish fish =
            test::fishAt(eye + away * glm::normalize(glm::vec3{-0.15F, 0, -1}), {1, 0, 0, 0});
        left.update({&fish, 1}, leftClip, eye);
        right.update({&fish, 1}, rightClip, eye);
        if (left.counts().visible + right.counts().visible < 2) continue;
        EXPECT_EQ(levelOf(left.counts()), levelOf(right.counts()));
        ++compared;
    }
    EXPECT_GT(compared, 100);
}

TEST_F(SchoolSurfaceTest, aSchoolThatDoesNotFitIsEvaluatedInTurns) {
    constexpr std::size_t kRoomFor = 5;
    SurfaceOptions options{.culling = false, .levelsOfDetail = false};
    options.fish = kRoomFor;
    SchoolSurface surface{body_, repertoire_, options, makeSkinPrograms()};
    const std::size_t vertices = makeLimitTable(body_, 2).vertices.size();
    std::vector<PresentedFish> school;
    for (std::size_t i = 0; i < kRoomFor + 2; ++i) {
        // Nearer and nearer: the last fish is drawn last.
        school.push_back(
            test::fishAt({0, 0, -3.0F + 0.002F * static_cast<float>(i)}, {1, 0, 0, 0}));
        school.back().id = static_cast<std::uint32_t>(i);
    }
    surface.update(school, clip_, glm::vec3{0});
    glEnable(GL_RASTERIZER_DISCARD);
    const gl::Framebuffer target;
    glNamedFramebufferParameteri(target.name(), GL_FRAMEBUFFER_DEFAULT_WIDTH, 8);
    glNamedFramebufferParameteri(target.name(), GL_FRAMEBUFFER_DEFAULT_HEIGHT, 8);
    glBindFramebuffer(GL_FRAMEBUFFER, target.name());
    surface.draw();
    glDisable(GL_RASTERIZER_DISCARD);
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    EXPECT_EQ(surface.counts().visible, static_cast<int>(school.size()));
    // The second turn holds two fish, from the beginning of the buffer again.
    EXPECT_LT(
        largestDistance(surfacePositions(vertices, vertices), expectedPositions(school.back(), 2)),
        1e-4F * school.back().lengthMetres);
}

TEST_F(SchoolSurfaceTest, anEmptySeaIsDrawnWithoutError) {
    SchoolSurface surface{body_, repertoire_, {}, makeSkinPrograms()};
    surface.update({}, clip_, glm::vec3{0});
    surface.draw();
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    EXPECT_EQ(surface.counts().visible, 0);
}

// Its skin is computed from nodal points, which are rounded to 16 bits as the control points are.
TEST_F(SchoolSurfaceTest, aSegmentWithoutControlPointsIsDrawnAllTheSame) {
    Repertoire bare = repertoire_;
    bare.segments[2].controlPoints.clear();
    SchoolSurface surface{
        body_, bare, {.culling = false, .levelsOfDetail = false}, makeSkinPrograms()};
    PresentedFish fish = test::fishAt({0, 0, -1}, {1, 0, 0, 0});
    fish.segment = 2;
    fish.phase = 0.5F;
    surface.update(std::span(&fish, 1), clip_, glm::vec3{0});
    const auto expected = expectedPositions(fish, 2);
    EXPECT_LT(largestDistance(surfacePositions(expected.size()), expected),
              2e-4F * fish.lengthMetres);
}

}  // namespace
}  // namespace aquarama
