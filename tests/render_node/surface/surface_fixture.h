// SPDX-License-Identifier: Apache-2.0
// A context, a scad that sways, and ways to read what the GPU made of a school.
#pragma once

#include <cmath>
#include <memory>
#include <random>
#include <span>
#include <vector>

#include <epoxy/gl.h>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "common/skin/limit_table.h"
#include "render_node/gl/context.h"
#include "render_node/gl/handle.h"
#include "render_node/shaders/frame_uniforms.h"
#include "render_node/surface/school_surface.h"
#include "tests/render_node/surface/test_fish.h"

namespace aquarama::test {

// A camera at the origin; reversed depth, zero to one.
inline glm::mat4 clipFromCamera(float verticalRadians, float aspect) {
    constexpr float kNear = 0.05F;
    const float f = 1.0F / std::tan(verticalRadians / 2);
    glm::mat4 clip{0.0F};
    clip[0][0] = f / aspect;
    clip[1][1] = f;
    clip[2][3] = -1.0F;
    clip[3][2] = kNear;
    return clip;
}

inline glm::quat anyRotation(std::mt19937& random) {
    std::normal_distribution<float> normal;
    return glm::normalize(
        glm::quat(normal(random), normal(random), normal(random), normal(random)));
}

inline constexpr float kSeconds = 3.7F;  // of the show

class SurfaceTest : public testing::Test {
  protected:
    SurfaceTest() {
        shaders::FrameUniforms uniforms{};
        uniforms.eyeAndTime.w = kSeconds;
        glNamedBufferStorage(frameBlock_.name(), sizeof(uniforms), &uniforms, 0);
        glBindBufferBase(GL_UNIFORM_BUFFER, 0, frameBlock_.name());
    }
    static void SetUpTestSuite() {
        context() = gl::makeOffscreenContext("mesa", {64, 64});
        programs() = surface::makeSkinPrograms();
    }
    static void TearDownTestSuite() {
        programs().reset();
        context().reset();
    }
    static std::unique_ptr<gl::Context>& context() {
        static std::unique_ptr<gl::Context> one;
        return one;
    }
    static std::shared_ptr<const surface::SkinPrograms>& programs() {
        static std::shared_ptr<const surface::SkinPrograms> all;
        return all;
    }

    template <class T>
    static std::vector<T> storage(GLuint binding, std::size_t count, std::size_t first = 0) {
        int buffer = 0;
        glGetIntegeri_v(GL_SHADER_STORAGE_BUFFER_BINDING, binding, &buffer);
        std::vector<T> values(count);
        glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
        glGetNamedBufferSubData(static_cast<GLuint>(buffer),
                                static_cast<GLintptr>(first * sizeof(T)),
                                static_cast<GLsizeiptr>(count * sizeof(T)),
                                values.data());
        return values;
    }
    // The fish that the last look found, in the order in which they are drawn.
    static std::vector<surface::DrawnFish> drawn(const surface::SchoolSurface& surface) {
        return storage<surface::DrawnFish>(0, surface.counts().visible);
    }
    // Positions of the first vertices in the last page of surfaces, once fish have been drawn.
    static std::vector<glm::vec3> surfacePositions(std::size_t count, std::size_t first = 0) {
        const auto vertices = storage<glm::vec4>(5, count, first);
        return {vertices.begin(), vertices.end()};
    }
    // Evaluates surfaces, and draws them to nowhere.
    static void evaluate(const surface::SchoolSurface& surface) {
        const gl::Framebuffer target;
        glNamedFramebufferParameteri(target.name(), GL_FRAMEBUFFER_DEFAULT_WIDTH, 8);
        glNamedFramebufferParameteri(target.name(), GL_FRAMEBUFFER_DEFAULT_HEIGHT, 8);
        glBindFramebuffer(GL_FRAMEBUFFER, target.name());
        glEnable(GL_RASTERIZER_DISCARD);
        surface.drawBodies();
        surface.drawBlended();
        glDisable(GL_RASTERIZER_DISCARD);
        glBindFramebuffer(GL_FRAMEBUFFER, 0);
        EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    }

    [[nodiscard]] surface::SchoolSurface surfaceFor(
        std::span<const motion::FishTraits> traits,
        const surface::SurfaceOptions& options = {}) const {
        const std::vector<surface::SchoolSpecies> cast{
            {body_, {}, repertoire_, {traits.begin(), traits.end()}}};
        return {cast, options, programs()};
    }

    const gl::Buffer frameBlock_;
    const body::FishBody body_ = scadBody();
    const motion::Repertoire repertoire_ = swaying(body_, 0.12F);
    const glm::mat4 clip_ = clipFromCamera(1.0F, 1.5F);
};

}  // namespace aquarama::test
