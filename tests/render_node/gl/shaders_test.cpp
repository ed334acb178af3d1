// SPDX-License-Identifier: Apache-2.0
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base/log.h"
#include "render_node/gl/context.h"
#include "render_node/gl/handle.h"
#include "render_node/gl/program.h"

namespace aquarama::gl {
namespace {

bool isStage(std::string_view name) {
    return name.ends_with(".vert") || name.ends_with(".frag") || name.ends_with(".comp");
}

// Compiled alone: neighbours in the pipeline are not needed.
std::string logOfCompiling(const std::string& name, const ReadShader& read = shaderSource) {
    try {
        (void)compileShader(name, {}, read);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
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

// Three files, the second of which is included in the middle of the first and includes the third.
std::string_view brokenShader(std::string_view name) {
    if (name == "broken.frag")
        return "// A mistake in the last line.\n"
               "#include \"middle.glsl\"\n"
               "layout(location = 0) out vec4 colour;\n"
               "void main() { colour = nowhere; }\n";
    if (name == "worse.frag")
        return "#include \"middle.glsl\"\n#include \"wrong.glsl\"\nvoid main() {}\n";
    if (name == "middle.glsl") return "// Two lines\n#include \"deep.glsl\"\nfloat b = a;";
    if (name == "wrong.glsl") return "\n\nfloat c = vec2(1.0);\n";
    return "float a = 1.0;\n\n";
}

TEST(Shaders, aMistakeIsPlacedInItsFileAndLine) {
    const auto context = makeOffscreenContext("auto", {16, 16});
    EXPECT_THAT(
        logOfCompiling("broken.frag", brokenShader),
        testing::AllOf(testing::HasSubstr("render_node/shaders/broken.frag does not compile"),
                       testing::HasSubstr("broken.frag:4"),
                       testing::HasSubstr("nowhere")));
    EXPECT_THAT(logOfCompiling("worse.frag", brokenShader), testing::HasSubstr("wrong.glsl:3"));
}

// In the text that is compiled: the version, the third file's two lines, the second's first and
// third, and so on.
TEST(Shaders, theLogOfEveryDriverNamesFiles) {
    const ShaderText shader = expand("worse.frag", brokenShader);
    EXPECT_EQ(withFiles("0:8(5): error: no\n0:3(1): warning: yes\n", shader),
              "wrong.glsl:3(5): error: no\ndeep.glsl:1(1): warning: yes\n");
    EXPECT_EQ(withFiles("0(5) : error C1008: no\n", shader), "middle.glsl:3 : error C1008: no\n");
    EXPECT_EQ(withFiles("ERROR: 0:9: no\n", shader), "ERROR: worse.frag:3: no\n");
    EXPECT_EQ(withFiles("0:99(1): error: a line that is not ours", shader),
              "0:99(1): error: a line that is not ours");
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
