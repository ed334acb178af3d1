// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "common/units/error.h"
#include "render_node/context/context.h"
#include "render_node/gl/program.h"
#include "render_node/gl/target.h"

namespace aquarama::gl {
namespace {

bool isStage(std::string_view name) {
    return name.ends_with(".vert") || name.ends_with(".frag") || name.ends_with(".comp");
}

// Compiled alone, as a separable program: neighbours in the pipeline are not needed.
std::string logOfCompiling(const std::string& name) {
    const GLenum stage = name.ends_with(".vert")   ? GL_VERTEX_SHADER
                         : name.ends_with(".frag") ? GL_FRAGMENT_SHADER
                                                   : GL_COMPUTE_SHADER;
    const std::string source = "#version 450 core\n" + shaderSource(name);
    const char* text = source.c_str();
    const unsigned shader = glCreateShader(stage);
    glShaderSource(shader, 1, &text, nullptr);
    glCompileShader(shader);
    int compiled = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    std::string log(4096, '\0');
    GLsizei length = 0;
    glGetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
    log.resize(static_cast<std::size_t>(length));
    glDeleteShader(shader);
    return compiled != 0 ? "" : "does not compile: " + log;
}

TEST(Shaders, everyFileCompiles) {
    const auto context = makeOffscreenContext("auto", {16, 16});
    int stages = 0;
    for (const std::string_view name : shaderNames()) {
        if (!isStage(name)) continue;
        ++stages;
        EXPECT_EQ(logOfCompiling(std::string(name)), "") << name;
    }
    EXPECT_GE(stages, 3);
}

TEST(Shaders, aMissingFileIsNamed) {
    try {
        (void)shaderSource("kraken.frag");
        FAIL() << "a shader that is not there was taken";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("kraken.frag"), std::string::npos);
    }
}

TEST(Target, isReadTopRowFirst) {
    const auto context = makeOffscreenContext("auto", {16, 16});
    const Target target(GL_RGBA8, {2, 2});
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer());
    glEnable(GL_SCISSOR_TEST);
    const auto fill = [](int x, int y, float red) {
        glScissor(x, y, 1, 1);
        glClearColor(red, 0, 0, 1);
        glClear(GL_COLOR_BUFFER_BIT);
    };
    fill(0, 0, 0.0F);  // OpenGL's bottom left
    fill(1, 0, 0.2F);
    fill(0, 1, 0.4F);
    fill(1, 1, 0.6F);
    glDisable(GL_SCISSOR_TEST);
    const std::vector<std::uint8_t> expected{102, 0, 0, 153, 0, 0, 0, 0, 0, 51, 0, 0};
    EXPECT_EQ(readRgb<std::uint8_t>(target), expected);
}

}  // namespace
}  // namespace aquarama::gl
